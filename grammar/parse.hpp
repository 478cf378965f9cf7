// SPDX-License-Identifier: MIT
#pragma once

#include "base/diagnostic.hpp"
#include "grammar/ast.hpp"

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

/// `abbe dump --tokens`: one token a line, `line:col kind text`.
std::string dump_tokens(SourceFile const& source);
/// `abbe dump --ast`: an indented tree with spans.
std::string dump_ast(ast::Document const& document);

} // namespace abbe
