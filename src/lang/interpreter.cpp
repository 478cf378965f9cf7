// SPDX-License-Identifier: MIT
#include "lang/interpreter.hpp"

#include <fmt/format.h>
#include <new>

namespace abbe::lang {
namespace {

/// What one evaluation may use of the stack of evaluate()'s thread; see evaluate.cpp.
constexpr std::uintptr_t stack_share = std::uintptr_t{448} << 20;

std::uintptr_t stack_pointer() {
  return reinterpret_cast<std::uintptr_t>(__builtin_frame_address(0));
}

} // namespace

Interpreter::Interpreter(EvaluateOptions const& options, SourceSet& sources)
    : reader(*this),
      expressions(*this),
      files(*this),
      streams(*this),
      options_(options),
      sources_(sources) {
  for (std::size_t i = 1; i < constant_names.size(); ++i) scope.intern(constant_names[i]);
  for (auto const& function : builtins()) scope.intern(function.name);
  stack_limit_ = stack_pointer() - stack_share;
  state.scene.settings.effects.strict = options.strict;
  state.instances.most_copied = options.most_copied_shapes;
}

ast::Document const& Interpreter::document(SourceFile const& source) {
  auto& known = documents_[&source];
  if (!known) {
    Parsed parsed = parse(source);
    known = std::make_unique<ast::Document>(std::move(parsed.document));
    for (auto& error : parsed.errors)
      report(error.severity, error.code, std::move(error.message), error.span,
             std::move(error.notes));
  }
  return *known;
}

void Interpreter::add(Diagnostic diagnostic) {
  Span const span = diagnostic.span;
  std::string const key = fmt::format("{} {} {} {}", static_cast<void const*>(span.source),
                                      span.begin, span.end, diagnostic.message);
  if (!said_.insert(key).second) return;
  diagnostics_.push_back(std::move(diagnostic));
  tell(diagnostics_.back());
  if (diagnostics_.back().severity != Severity::Error) return;
  if (++errors_ < options_.max_errors) return;
  diagnostics_.push_back({"E0701",
                          Severity::Error,
                          {},
                          fmt::format("{} errors: the rest is not looked at", errors_),
                          {}});
  tell(diagnostics_.back());
  ++errors_;
  abort();
}

void Interpreter::tell(Diagnostic const& diagnostic) {
  if (!options_.on_diagnostic) return;
  if (streams.none())
    options_.on_diagnostic(diagnostic);
  else
    messages_.emplace_back(diagnostic);
}

void Interpreter::say(std::string_view text) {
  if (!options_.on_message) return;
  if (streams.none())
    options_.on_message(text);
  else
    messages_.emplace_back(std::string(text));
}

Mark Interpreter::mark() const {
  return {diagnostics_.size(), messages_.size(), texts.size(), errors_};
}

void Interpreter::roll_back(Mark const& mark) {
  diagnostics_.erase(diagnostics_.begin() + static_cast<std::ptrdiff_t>(mark.diagnostics),
                     diagnostics_.end());
  messages_.erase(messages_.begin() + static_cast<std::ptrdiff_t>(mark.messages), messages_.end());
  texts.resize(mark.texts);
  errors_ = mark.errors;
}

void Interpreter::release_messages() {
  for (auto const& message : messages_)
    if (auto const* text = std::get_if<std::string>(&message))
      options_.on_message(*text);
    else
      options_.on_diagnostic(std::get<Diagnostic>(message));
  messages_.clear();
}

void Interpreter::check_limits(Span span) {
  place_ = span;
  if (stopped()) abort();
  if (stack_pointer() > stack_limit_) return;
  stack_limit_ = 0; // room for the report
  error("E0702", "blocks and expressions nest too deeply here", span);
  abort();
}

std::string Interpreter::suggestion(std::string_view name,
                                    std::vector<std::string_view> const& nearer) const {
  if (auto hint = files.include_hint(name); !hint.empty()) return hint;
  if (auto hint = did_you_mean(name, nearer); !hint.empty()) return hint;
  auto others = scope.declared();
  for (auto const& kind : block_kinds()) others.push_back(kind.head);
  for (auto const& function : builtins()) others.push_back(function.name);
  return did_you_mean(name, others);
}

void Interpreter::run(SourceFile const& source) {
  try {
    run_statements(source);
  } catch (Aborted const&) {
    streams.abandon();
    throw;
  }
}

void Interpreter::run_statements(SourceFile const& source) {
  if (!options_.before.empty())
    read_text(*this, "options", options_.before, [](Reader& in) {
      while (!in.at_end()) read_statement(in);
    });
  Span const whole{&source, 0, static_cast<std::uint32_t>(source.text().size())};
  StatementStream* const stream = streams.open(source);
  ast::Items const& statements = stream != nullptr ? stream->statements : document(source).items;
  if (errors_ > 0) return;
  reader.enter_region(statements, whole);
  reader.read_from(stream);
  try {
    place_ = reader.next_span();
    while (!reader.at_end()) read_statement(reader);
    finish_scene(reader);
    tell_not_rendered();
  } catch (std::bad_alloc const&) {
    error("E0706", "there is no memory left for what the scene makes here", place_);
    abort();
  }
  reader.leave_region();
  if (stream != nullptr) streams.close();
  state.scene.settings.version = state.effective_version;
  files.finish();
}

// What block readers ask of the interpreter (blocks.hpp).

SceneState& scene_state(Interpreter& in) {
  return in.state;
}

std::filesystem::path const& stdlib_dir(Interpreter& in) {
  return in.options().stdlib_dir;
}

Result<std::string> load_file(Interpreter& in, std::string_view path_as_written) {
  auto found = in.files.load(path_as_written, in.reader.current_source());
  if (!found) return found.error();
  return std::move(found->text).take();
}

void read_text(Interpreter& in, std::string name, std::string text,
               std::function<void(Reader&)> const& read) {
  SourceFile const& source = in.add_source(std::move(name), std::move(text));
  int const before = in.error_count();
  ast::Document const& document = in.document(source);
  if (in.error_count() > before) return;
  in.reader.enter_region(document.items,
                         {&source, 0, static_cast<std::uint32_t>(source.text().size())});
  read(in.reader);
  in.reader.leave_region();
}

} // namespace abbe::lang
