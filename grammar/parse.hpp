// SPDX-License-Identifier: MIT
#pragma once

#include "base/diagnostic.hpp"
#include "grammar/ast.hpp"

#include <cstddef>
#include <memory>
#include <optional>
#include <vector>

namespace abbe {

/// What came of a parse: the tree as far as it could be made, and every syntax error found
/// (after one, parsing resumes at the next place where a statement can start).
struct Parsed {
  ast::Document document;
  std::vector<Diagnostic> errors;
};

/// Syntax only: reads no other file, knows no shape and no keyword's meaning.
/// Limits (E07xx): nesting of 1000 blocks or parentheses, 4 GiB of text.
Parsed parse(SourceFile const& source);

/// An item of an ast::Text, read without regard to what it stands in: a block is its head with '{'
/// (`open`, and empty), the '}' that closes it a Punctuation, a #declare ends behind its '='. Only
/// vectors, parentheses, and functions, arrays, directives with their bodies are read whole.
struct LooseItem {
  ast::Items items; ///< one; none at the end of the text
  std::uint32_t end = 0;
  std::optional<Diagnostic> error;
};
/// @param full whether it stands in parentheses, where values are compared
LooseItem parse_loose(Span text, std::uint32_t from, bool full);

/// parse() piece by piece, for sources whose tree would be large: the pieces, one behind another,
/// are what parse() gives, trees and errors.
class StatementParser {
public:
  explicit StatementParser(SourceFile const& source);
  ~StatementParser();
  /// Nothing is left to be read.
  bool at_end() const;
  /// The statements that begin within so many bytes of text from here, of which there may be none,
  /// and the errors found on the way.
  struct Piece {
    std::vector<Diagnostic> errors;
    bool lasting = false; ///< a macro or a function stands in them: values will refer to the tree
  };
  /// `statements` are replaced; their memory is used again.
  Piece next(std::size_t bytes, ast::Items& statements);

private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// Does a comma stand next behind the span, but for blanks and comments? The tree has no commas.
bool comma_behind(Span const& span);

/// `abbe dump --tokens`: one token a line, `line:col kind text`.
std::string dump_tokens(SourceFile const& source);
/// `abbe dump --ast`: an indented tree with spans.
std::string dump_ast(ast::Document const& document);

} // namespace abbe
