// SPDX-License-Identifier: MIT
#include "grammar/parse.hpp"

#include <fmt/format.h>
#include <iterator>

namespace abbe {
namespace {

constexpr char const* unary_names[] = {"+", "-", "!"};
constexpr char const* binary_names[] = {"+", "-",  "*", "/",  "&",  "|",
                                        "<", "<=", "=", "!=", ">=", ">"};

/// Text as it is, control characters as \xNN.
std::string in_quotes(std::string_view text) {
  std::string out = "\"";
  for (char const c : text)
    if (static_cast<unsigned char>(c) < 32)
      out += fmt::format("\\x{:02x}", static_cast<unsigned char>(c));
    else
      out += c;
  out += '"';
  return out;
}

std::string joined(std::vector<ast::Name> const& names) {
  std::vector<std::string_view> texts;
  for (auto const& name : names) texts.push_back(name.text);
  return fmt::format("({})", fmt::join(texts, ", "));
}

class Dumper {
public:
  std::string out;

  void list(ast::Items const& items) {
    for (auto const& item : items) ast::visit(*this, item);
  }
  void labelled(char const* label, ast::Items const& items) {
    fmt::format_to(std::back_inserter(out), "{:{}}{}:\n", "", indent_, label);
    Deeper const deeper(*this);
    list(items);
  }

  void operator()(ast::Expr const& node) { ast::visit(*this, node); }
  void operator()(ast::Number const& node) {
    line("Number", node.span, fmt::format("{}", node.value));
  }
  void operator()(ast::LiteralVector const& node) {
    std::string text;
    for (int i = 0; i < node.size; ++i)
      text += fmt::format("{}{}", i > 0 ? " " : "", node.values[i]);
    line("LiteralVector", node.span, text);
  }
  void operator()(ast::LiteralVectors const& node) {
    for (std::size_t i = 0; i < node.count(); ++i) (*this)(node[i]);
  }
  void operator()(ast::Name const& node) {
    line("Name", node.span, node.text + (node.reserved ? " reserved" : ""));
  }
  void operator()(ast::String const& node) { line("String", node.span, in_quotes(node.text)); }
  void operator()(ast::Vector const& node) { nested("Vector", node.span, "", node.components); }
  void operator()(ast::Unary const& node) {
    line("Unary", node.span, unary_names[static_cast<int>(node.op)]);
    children(node.operand);
  }
  void operator()(ast::Binary const& node) {
    line("Binary", node.span, binary_names[static_cast<int>(node.op)]);
    children(node.left, node.right);
  }
  void operator()(ast::Conditional const& node) {
    line("Conditional", node.span, "");
    children(node.condition, node.yes, node.no);
  }
  void operator()(ast::Member const& node) {
    line("Member", node.span, node.member.text);
    children(node.operand);
  }
  void operator()(ast::Index const& node) {
    line("Index", node.span, node.array.text);
    children(node.subscripts);
  }
  void operator()(ast::Call const& node) {
    line("Call", node.span, node.callee.text + (node.callee.reserved ? " reserved" : ""));
    Deeper const deeper(*this);
    for (auto const& element : node.element) (*this)(element);
    for (auto const& argument : node.arguments) labelled("argument", argument);
  }
  void operator()(ast::Paren const& node) { nested("Paren", node.span, "", node.items); }
  void operator()(ast::Array const& node) {
    line("Array", node.span, node.has_elements ? "with elements" : "");
    children(node.sizes);
    if (!node.has_elements) return;
    Deeper const deeper(*this);
    labelled("elements", node.elements);
  }
  void operator()(ast::Function const& node) {
    line("Function", node.span, node.has_parameters ? joined(node.parameters) : std::string{});
    children(node.sizes);
    Deeper const deeper(*this);
    labelled("body", node.body);
  }
  void operator()(ast::Block const& node) {
    std::string text = node.head.text;
    if (node.head.reserved) text += " reserved";
    if (node.open) text += " open";
    nested("Block", node.span, text, node.items);
  }
  void operator()(ast::Word const& node) { line("Word", node.span, node.text); }
  void operator()(ast::Bracket const& node) { nested("Bracket", node.span, "", node.items); }
  void operator()(ast::Punctuation const& node) {
    line("Punctuation", node.span, std::string(1, node.symbol));
  }
  void operator()(ast::Text const& node) { line("Text", node.span, ""); }
  void operator()(ast::If const& node) {
    static constexpr char const* names[] = {"if", "ifdef", "ifndef", "else"};
    line("If", node.span, node.open_blocks > 0 ? "with tail" : "");
    Deeper const deeper(*this);
    for (auto const& branch : node.branches) {
      line("Branch", branch.span, names[static_cast<int>(branch.test)]);
      if (branch.test != ast::If::Branch::Test::Else) children(branch.condition);
      Deeper const inner(*this);
      list(branch.items);
    }
    if (node.open_blocks > 0) labelled("tail", node.tail);
  }
  void operator()(ast::While const& node) {
    line("While", node.span, "");
    children(node.condition);
    Deeper const deeper(*this);
    list(node.items);
  }
  void operator()(ast::For const& node) {
    line("For", node.span, node.counter.text);
    children(node.arguments);
    Deeper const deeper(*this);
    labelled("body", node.items);
  }
  void operator()(ast::Switch const& node) {
    static constexpr char const* names[] = {"case", "range", "else"};
    line("Switch", node.span, "");
    children(node.value);
    Deeper const deeper(*this);
    if (!node.before.empty()) labelled("before", node.before);
    for (auto const& clause : node.clauses) {
      line("Clause", clause.span, names[static_cast<int>(clause.kind)]);
      children(clause.bounds);
      Deeper const inner(*this);
      labelled("body", clause.items);
    }
  }
  void operator()(ast::Declare const& node) {
    std::string text = node.local ? "local" : "declare";
    if (node.deprecated) text += " deprecated";
    if (node.deprecated_once) text += " once";
    if (node.deprecation.span.valid()) text += ' ' + in_quotes(node.deprecation.text);
    line("Declare", node.span, text + (node.has_semicolon ? " ;" : ""));
    children(node.target);
    Deeper const deeper(*this);
    labelled("value", node.value);
  }
  void operator()(ast::Macro const& node) {
    nested("Macro", node.span, node.name.text + joined(node.parameters), node.body);
  }
  void operator()(ast::Directive const& node) {
    nested("Directive", node.span, node.open ? node.word + " open" : node.word, node.arguments);
  }

private:
  struct Deeper {
    explicit Deeper(Dumper& d) : dumper(d) { dumper.indent_ += 2; }
    ~Deeper() { dumper.indent_ -= 2; }
    Deeper(Deeper const&) = delete;
    Deeper& operator=(Deeper const&) = delete;
    Dumper& dumper;
  };

  void line(char const* kind, Span const& span, std::string_view text) {
    fmt::format_to(std::back_inserter(out), "{:{}}{} [{}-{}]{}{}\n", "", indent_, kind, span.begin,
                   span.end, text.empty() ? "" : " ", text);
  }
  void nested(char const* kind, Span const& span, std::string_view text, ast::Items const& items) {
    line(kind, span, text);
    Deeper const deeper(*this);
    list(items);
  }
  void children(std::vector<ast::Expr> const& list) {
    Deeper const deeper(*this);
    for (auto const& expression : list) (*this)(expression);
  }
  template <class... Expressions>
  requires(std::is_same_v<Expressions, ast::Expr>&&...) void children(
      Expressions const&... expressions) {
    Deeper const deeper(*this);
    ((*this)(expressions), ...);
  }
  int indent_ = 0;
};

} // namespace

std::string dump_ast(ast::Document const& document) {
  Dumper dumper;
  dumper.list(document.items);
  return std::move(dumper.out);
}

} // namespace abbe
