// SPDX-License-Identifier: MIT
#include "grammar/plain_items.hpp"

#include <algorithm>
#include <cstring>

namespace abbe::grammar {
namespace {

/// So many vectors of one size are one node.
constexpr std::size_t many = 16;

/// Does the mark make more of an operand before it (Flavour::Bare)?
bool is_operator(char c) {
  return c == '*' || c == '/' || c == '+' || c == '-' || c == '?' || c == '.';
}

/// What stands next behind blanks, 0 at the end.
char next_char(Iterator at, Iterator last) {
  at = skip_blanks(at, last);
  return at == last ? '\0' : *at;
}

Plain scan_plain_number(Iterator& first, Iterator last, State const& state, ast::Item& out) {
  bool const sign = *first == '-' || *first == '+';
  Iterator at = first + sign;
  double value = 0;
  if (at == last || !(is_digit(*at) || *at == '.') || !scan_number(at, last, value))
    return Plain::No;
  if (is_operator(next_char(at, last))) return Plain::No;
  out = ast::Expr(ast::Number{state.span(first, at), *first == '-' ? -value : value});
  first = at;
  return Plain::Taken;
}

Plain scan_plain_word(Iterator& first, Iterator last, State& state, ast::Item& out) {
  // At the top level some directives may lack their '#'.
  if (state.brackets == 0 && (*first == 'd' || *first == 'i' || *first == 'v')) return Plain::No;
  std::string_view const word = scan_word(first, last);
  Iterator const end = first + word.size();
  WordKind const kind = word_kind(word);
  if (kind == WordKind::Directive || word == "function" || word == "array") return Plain::No;
  char const next = next_char(end, last);
  bool const operand = kind == WordKind::Operand;
  if (next == '{' && !operand) {
    ast::Name head{state.span(first, end), std::string(word), kind != WordKind::Name};
    out = ast::Expr(ast::Block{{}, std::move(head), {}, false});
    first = end;
    return Plain::Block;
  }
  if (operand || kind == WordKind::Name) {
    if (is_operator(next) || next == '(' || next == '[' || next == '{') return Plain::No;
    out = ast::Expr(ast::Name{state.span(first, end), std::string(word), operand});
    first = end;
    return Plain::Taken;
  }
  if (kind == WordKind::Function && next == '(') return Plain::No;
  ast::Word node;
  if (!WordLiteral{}.scan(first, last, state, node)) return Plain::No;
  out = std::move(node);
  return Plain::Taken;
}

/// Vectors of one size with nothing but commas between and a comma, a vector or the end of the
/// block behind each.
class VectorRun {
public:
  VectorRun(Iterator first, Iterator last, State& state)
      : first_(first), last_(last), state_(state) {}

  /// @return where it ends
  Iterator scan(ast::Items& items) {
    Iterator at = first_, end = first_;
    std::size_t count = 0;
    ast::LiteralVector one;
    while (at != last_ && *at == '<' && LiteralVector::scan_components(at, last_, state_, one)) {
      if (count != 0 && one.size != size_) break;
      Iterator const next = skip_blanks(at, last_);
      if (next == last_ || (*next != ',' && *next != '<' && *next != '}')) break;
      size_ = one.size;
      end = at;
      state_.pass(at);
      if (count < many)
        items.emplace_back(ast::Expr(one));
      else
        append(items, count, one);
      ++count;
      for (at = next; at != last_ && *at == ',';) at = skip_blanks(at + 1, last_);
    }
    if (count == many) gather(items);
    if (count >= many)
      ast::get_direct<ast::LiteralVectors>(items.back())->span = state_.span(first_, end);
    return end;
  }

private:
  void append(ast::Items& items, std::size_t count, ast::LiteralVector const& one) {
    if (count == many) gather(items);
    auto& node = *ast::get_direct<ast::LiteralVectors>(items.back());
    node.values.insert(node.values.end(), one.values, one.values + size_);
    node.begin.push_back(one.span.begin);
  }
  /// Makes one node of the last vectors.
  void gather(ast::Items& items) {
    ast::LiteralVectors node;
    node.size = size_;
    reserve(node, *ast::get_if<ast::LiteralVector>(items.back()));
    for (std::size_t i = items.size() - many; i < items.size(); ++i) {
      auto const& one = *ast::get_if<ast::LiteralVector>(items[i]);
      node.values.insert(node.values.end(), one.values, one.values + size_);
      node.begin.push_back(one.span.begin);
    }
    items.resize(items.size() - many);
    items.emplace_back(std::move(node));
  }
  /// Room for as many as would fit before the next '}', were all as long as the first ones. What is
  /// not used of it is never touched.
  void reserve(ast::LiteralVectors& node, ast::LiteralVector const& latest) const {
    Iterator const here = state_.begin + latest.span.end;
    auto const left = static_cast<std::size_t>(last_ - here);
    auto const* const end = static_cast<char const*>(std::memchr(here, '}', left));
    std::size_t const bytes = end == nullptr ? left : static_cast<std::size_t>(end - here);
    auto const each = static_cast<std::size_t>(here - first_) / many;
    std::size_t const count = many + bytes / each;
    std::size_t const likely = count + count / 16;
    node.values.reserve(likely * size_);
    node.begin.reserve(likely);
  }

  Iterator const first_;
  Iterator const last_;
  State& state_;
  std::uint8_t size_ = 0;
};

} // namespace

bool scan_vectors(Iterator& first, Iterator last, State& state, ast::Items& items) {
  if (state.flavour != Flavour::Bare || state.bracket != '{') return false;
  Iterator const end = VectorRun(first, last, state).scan(items);
  return std::exchange(first, end) != end;
}

Plain scan_plain(Iterator& first, Iterator last, State& state, ast::Item& out) {
  if (first == last || state.flavour != Flavour::Bare) return Plain::No;
  if (is_name_start(*first)) return scan_plain_word(first, last, state, out);
  if (*first != '<') return scan_plain_number(first, last, state, out);
  Iterator at = first;
  ast::LiteralVector vector;
  if (!LiteralVector::scan_components(at, last, state, vector)) return Plain::No;
  if (is_operator(next_char(at, last))) return Plain::No;
  out = ast::Expr(vector);
  first = at;
  return Plain::Taken;
}

} // namespace abbe::grammar
