// SPDX-License-Identifier: MIT
#pragma once

#include "base/diagnostic.hpp"
#include "grammar/parse.hpp"
#include "lang/blocks.hpp"
#include "lang/deferral.hpp"
#include "lang/evaluate.hpp"
#include "lang/expression.hpp"
#include "lang/files.hpp"
#include "lang/reader_impl.hpp"
#include "lang/scope.hpp"
#include "lang/statement_streams.hpp"

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <unordered_map>
#include <unordered_set>
#include <variant>
#include <vector>

namespace abbe::lang {

struct InternalFunction;

/// Thrown to leave an evaluation that cannot go on (`#error`, too many errors, the stop flag,
/// nesting without end) after the reason was reported. Caught by evaluate_file and evaluate_text
/// only.
struct Aborted {};

/// One run over a scene: its names, files, messages and the scene that grows. The pieces that do
/// the work (Reader, expressions, files) know each other through it.
class Interpreter {
public:
  Interpreter(EvaluateOptions const& options, SourceSet& sources);

  Scope scope;
  std::vector<SourceFile const*> texts; ///< all that add_source took
  SceneState state;
  ReaderImpl reader;
  Expressions expressions;
  Files files;
  StatementStreams streams;
  /// Those of functions.inc that were asked for, and what they call.
  std::unordered_map<InternalFunction const*, std::shared_ptr<FunctionValue const>> internals;
  Deferral* deferral = nullptr;              ///< of the innermost value that is being declared
  std::vector<std::uint32_t> random_streams; ///< state of each stream of seed()
  double version = 3.7;                      ///< what `version` yields

  EvaluateOptions const& options() const { return options_; }

  /// Runs a whole scene. A source with errors of syntax is not evaluated, or as if it were not.
  void run(SourceFile const& source);

  /// Parses a source, once; its syntax errors are reported. The tree lives as long as the run.
  ast::Document const& document(SourceFile const& source);
  SourceFile const& add_source(std::string name, FileText text) {
    texts.push_back(&sources_.add(std::move(name), std::move(text)));
    return *texts.back();
  }

  /// Adds a message with the chain of macro calls and includes that led to it. The same message at
  /// the same place is given once. Too many errors abort the run. Of a value that is being
  /// declared, what is not supported yet is kept: see Deferral.
  void report(Severity, std::string_view code, std::string message, Span,
              std::vector<Diagnostic::Note> notes = {});
  void error(std::string_view code, std::string message, Span span) {
    report(Severity::Error, code, std::move(message), span);
  }
  void warning(std::string message, Span span) {
    report(Severity::Warning, "", std::move(message), span);
  }
  /// Tells what the scene calls for and is not rendered yet: once a word, at its first place.
  /// Warnings, or errors where `strict` was said.
  void tell_not_rendered();
  /// Tells what was deferred of something that is used at `at`.
  void use(Few<Diagnostic> const& deferred, Span at);
  /// Adds a message as it is. @throws Aborted when there are too many errors
  void add(Diagnostic);
  /// The text of `#debug`.
  void say(std::string_view text);
  /// What was said so far; to unsay what was said since; to let go what was said while a stream was
  /// read.
  Mark mark() const;
  void roll_back(Mark const&);
  void release_messages();
  [[noreturn]] void abort() const { throw Aborted{}; }
  /// To be called in every loop of the user's and at every nesting: leaves when the stop flag is
  /// set or the stack runs out.
  void check_limits(Span);
  bool stopped() const { return options_.stop && options_.stop->load(std::memory_order_relaxed); }

  std::vector<Diagnostic> take_diagnostics() { return std::move(diagnostics_); }
  int error_count() const { return errors_; }
  /// Was there an error since the last call, be it one that was reported before? What is not
  /// supported yet does not count: it leaves no variable unset.
  bool wrong_since_asked() { return std::exchange(wrong_since_asked_, false); }

  /// What may be meant by an unknown name: `; colors.inc declares it: #include "colors.inc"`, or ";
  /// did you mean 'Radius'?" out of `nearer`, else out of the declared names and the heads of
  /// blocks.
  std::string suggestion(std::string_view name,
                         std::vector<std::string_view> const& nearer = {}) const;

private:
  void tell(Diagnostic const&);
  void run_statements(SourceFile const& source);
  void keep_or_add(Diagnostic);

  EvaluateOptions const& options_;
  SourceSet& sources_;
  std::unordered_map<SourceFile const*, std::unique_ptr<ast::Document>> documents_;
  std::vector<Diagnostic> diagnostics_;
  /// Texts of #debug and diagnostics that wait while a stream is read.
  std::vector<std::variant<std::string, Diagnostic>> messages_;
  std::unordered_set<std::string> said_;
  int errors_ = 0;
  std::uintptr_t stack_limit_ = 0; ///< the lowest address that may be used
  Span place_;                     ///< of the latest loop, nesting or statement: for out of memory
  bool wrong_since_asked_ = false;
};

} // namespace abbe::lang
