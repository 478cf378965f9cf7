// SPDX-License-Identifier: MIT
#include "lang/evaluate.hpp"

#include "base/heap.hpp"
#include "base/read_file.hpp"
#include "lang/interpreter.hpp"

#include <algorithm>
#include <cstdlib>
#include <exception>
#include <fmt/format.h>
#include <pthread.h>

namespace abbe::lang {
namespace {

/// Deeply nested scenes recurse deeply: evaluation has a thread of its own with a stack of 512 MB,
/// of which only what is used is ever backed by memory (Interpreter::check_limits guards its end).
constexpr std::size_t stack_size = std::size_t{512} << 20;

/// Bytes of text from which on its trees are worth returning: a trim takes a tenth of a millisecond
/// and more.
constexpr std::size_t trees_that_count = std::size_t{1} << 20;

struct Work {
  std::function<void()> run;
  std::exception_ptr failure;
};

void* run_work(void* argument) {
  auto& work = *static_cast<Work*>(argument);
  try {
    work.run();
  } catch (...) {
    work.failure = std::current_exception();
  }
  return nullptr;
}

void on_large_stack(std::function<void()> run) {
  Work work{std::move(run), nullptr};
  pthread_attr_t attributes;
  pthread_t thread;
  pthread_attr_init(&attributes);
  pthread_attr_setstacksize(&attributes, stack_size);
  int const failed = pthread_create(&thread, &attributes, run_work, &work);
  pthread_attr_destroy(&attributes);
  if (failed != 0) throw std::bad_alloc(); // no memory for the stack, or no thread left
  pthread_join(thread, nullptr);
  if (work.failure) std::rethrow_exception(work.failure);
}

void declare_options(Interpreter& in) {
  for (auto const& [name, text] : in.options().declarations) {
    Value& value = in.scope.declare(in.scope.intern(name));
    char* end = nullptr;
    double const number = std::strtod(text.c_str(), &end);
    if (!text.empty() && end == text.c_str() + text.size())
      value.any = scalar_of(number);
    else if (text.size() >= 2 && text.front() == '"' && text.back() == '"')
      value.any = text.substr(1, text.size() - 2);
    else
      value.any = text;
  }
}

Evaluated evaluate(std::string name, FileText text, std::filesystem::path const& folder,
                   EvaluateOptions const& options) {
  Evaluated result;
  result.sources = std::make_unique<SourceSet>();
  SourceFile const& source = result.sources->add(std::move(name), std::move(text));
  on_large_stack([&] {
    Interpreter in(options, *result.sources);
    in.files.set_scene_folder(folder);
    try {
      declare_options(in);
      in.run(source);
    } catch (Aborted const&) {
      result.interrupted = options.stop && options.stop->load();
    }
    result.diagnostics = in.take_diagnostics();
    result.texts = std::move(in.texts);
    result.texts.push_back(&source);
    result.scene = std::move(in.state.scene);
  });
  for (SourceFile const* read : result.texts) {
    if (read->bytes().changed())
      result.diagnostics.push_back({"E0507",
                                    Severity::Error,
                                    {read, 0, 0},
                                    "this file was written to while it was read: try again",
                                    {}});
  }
  // What the trees took: the renderer needs it for other things.
  if (source.text().size() > trees_that_count) give_back_memory();
  return result;
}

} // namespace

bool Evaluated::ok() const {
  return !unreadable && !interrupted
         && std::none_of(diagnostics.begin(), diagnostics.end(),
                         [](Diagnostic const& d) { return d.severity == Severity::Error; });
}

Evaluated evaluate_file(std::filesystem::path const& path, EvaluateOptions const& options) {
  auto file = read_file(path);
  if (!file) {
    Evaluated result;
    result.sources = std::make_unique<SourceSet>();
    result.unreadable = true;
    result.diagnostics.push_back(
        {"E0501",
         Severity::Error,
         {},
         fmt::format("cannot read the file '{}': {}", path.generic_string(), file.error().message),
         {}});
    return result;
  }
  return evaluate(path.generic_string(), std::move(file->text), path.parent_path(), options);
}

Evaluated evaluate_text(std::string name, std::string text, EvaluateOptions const& options) {
  std::filesystem::path const folder = std::filesystem::path(name).parent_path();
  return evaluate(std::move(name), std::move(text), folder, options);
}

Result<scene::SpectralSettings> read_spectral(std::string const& phrases) {
  auto const read =
      evaluate_text("settings", "global_settings { spectral { " + phrases + " } }", {});
  for (auto const& diagnostic : read.diagnostics)
    if (diagnostic.severity == Severity::Error)
      return Error{std::string(diagnostic.code), diagnostic.message};
  return read.scene.settings.spectral;
}

} // namespace abbe::lang
