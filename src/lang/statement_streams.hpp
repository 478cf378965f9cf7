// SPDX-License-Identifier: MIT
#pragma once

#include "grammar/parse.hpp"

#include <memory>
#include <unordered_set>
#include <vector>

namespace abbe::lang {

class Interpreter;

/// How much was said up to some moment: diagnostics, texts of #debug, sources taken.
struct Mark {
  std::size_t diagnostics = 0, messages = 0, texts = 0;
  int errors = 0;
};

/// A large source that is evaluated while it is parsed: `statements` is the piece at hand. It
/// changes in place when the reader has come to its end.
struct StatementStream {
  explicit StatementStream(SourceFile const& source) : parser(source) {}

  ast::Items statements;
  ast::Items before; ///< the piece before: what was read last may still be looked at
  StatementParser parser;
  bool lasting = false;        ///< values refer to `statements`
  bool before_lasting = false; ///< and to `before`
  Mark mark;                   ///< what was said before the first statement
  std::vector<Diagnostic::Note> chain;
};

/// The sources that are being read that way, one including the other.
///
/// To the user it is as if each source were parsed whole before any of it is evaluated: a source
/// with syntax errors gives these and nothing of what its statements say. So messages wait until
/// the last statement is parsed, and are dropped, with the diagnostics, when a syntax error turns
/// up.
class StatementStreams {
public:
  explicit StatementStreams(Interpreter& interpreter) : in_(interpreter) {}

  /// A stream over the source if it is large and read for the first time; else nullptr, and it
  /// shall be parsed whole. The first piece is there. @throws Aborted after syntax errors were
  /// reported
  StatementStream* open(SourceFile const& source);
  /// The next piece; false when there is none. @throws Aborted
  bool next(StatementStream&);
  /// Of the innermost one: looks at the rest too if it was left early. @throws Aborted
  void close();
  /// After the evaluation was given up: errors of syntax further down go before what was said.
  void abandon();
  bool none() const { return streams_.empty(); }

private:
  void keep(ast::Items& statements, bool lasting);
  void report_syntax(std::vector<Diagnostic> errors);
  std::vector<Diagnostic> rest_of(StatementStream&);

  Interpreter& in_;
  std::vector<std::unique_ptr<StatementStream>> streams_;
  std::unordered_set<SourceFile const*> seen_;
  std::vector<ast::Items> kept_; ///< trees that macros and functions refer to
};

} // namespace abbe::lang
