// SPDX-License-Identifier: MIT
#pragma once

#include "grammar/config.hpp"

#include <array>
#include <string>

/// The tokens as X3 parsers. Each skips the blanks before it itself, so the grammar needs no
/// skipper and no lexeme[]; each makes its leaf node whole, span included.
namespace abbe::grammar {

/// Marks our parsers, so that what() asks them for their human name.
struct Labelled {};

template <class Derived, class Attribute>
struct Terminal : x3::parser<Derived>, Labelled {
  using attribute_type = Attribute;
  static bool const has_attribute = !std::is_same_v<Attribute, x3::unused_type>;

  template <class AnyContext, class RContext, class Actual>
  bool parse(Iterator& first, Iterator const& last, AnyContext const& context, RContext&,
             Actual& actual) const {
    Iterator at = skip_blanks(first, last);
    if (at == last) return false;
    if constexpr (!has_attribute || std::is_same_v<std::remove_const_t<Actual>, x3::unused_type>) {
      Attribute ignored{};
      if (!this->derived().scan(at, last, state_of(context), ignored)) return false;
    } else if constexpr (std::is_same_v<Actual, Attribute>) {
      if (!this->derived().scan(at, last, state_of(context), actual)) return false;
    } else {
      Attribute node{};
      if (!this->derived().scan(at, last, state_of(context), node)) return false;
      x3::traits::move_to(std::move(node), actual);
    }
    first = at;
    return true;
  }
};

/// A punctuation mark; '=' and the like are not split off two-character ones by the grammar's
/// design.
struct Mark : Terminal<Mark, x3::unused_type> {
  constexpr explicit Mark(char mark) : mark_(mark) {}
  bool scan(Iterator& at, Iterator, State&, x3::unused_type) const { return *at == mark_ && ++at; }
  std::string label() const { return {'\'', mark_, '\''}; }
  char mark_;
};

/// A given word.
struct Keyword : Terminal<Keyword, x3::unused_type> {
  constexpr explicit Keyword(std::string_view word) : word_(word) {}
  bool scan(Iterator& at, Iterator last, State&, x3::unused_type) const {
    if (scan_word(at, last) != word_) return false;
    at += word_.size();
    return true;
  }
  std::string label() const { return "'" + std::string(word_) + "'"; }
  std::string_view word_;
};

/// `#word`, one of several; yields the word. The blanks between are allowed.
template <std::size_t N>
struct Hash : Terminal<Hash<N>, std::string> {
  constexpr explicit Hash(std::array<std::string_view, N> words) : words_(words) {}
  bool scan(Iterator& at, Iterator last, State& state, std::string& out) const {
    std::string_view const word = *at == '#' ? directive_at(at, last) : hashless(at, last, state);
    if (word.empty()) return false;
    for (auto const& candidate : words_) {
      if (word != candidate) continue;
      out = std::string(word);
      at = word.data() + word.size();
      return true;
    }
    return false;
  }
  std::string label() const { return "'#" + std::string(words_[0]) + "'"; }

private:
  /// `default {`, `declare`, `include`, `version 3.7` do without '#' where a statement may stand.
  static std::string_view hashless(Iterator at, Iterator last, State const& state) {
    if (state.brackets != 0 || (*at != 'd' && *at != 'i' && *at != 'v')) return {};
    std::string_view const word = scan_word(at, last);
    if (word == "declare" || word == "default" || word == "include") return word;
    if (word != "version") return {};
    Iterator const next = skip_blanks(at + word.size(), last);
    return next != last && is_digit(*next) ? word : std::string_view{};
  }
  std::array<std::string_view, N> words_;
};
template <class... Words>
constexpr auto hash(Words... words) {
  return Hash<sizeof...(Words)>({std::string_view(words)...});
}

struct NumberLiteral : Terminal<NumberLiteral, ast::Number> {
  bool scan(Iterator& at, Iterator last, State& state, ast::Number& out) const {
    Iterator const begin = at;
    if (!(is_digit(*at) || *at == '.') || !scan_number(at, last, out.value)) return false;
    out.span = state.span(begin, at);
    return true;
  }
  std::string label() const { return "a number"; }
};

/// `<1, -2.5, 3>`: fails, for the general rule to try, when anything but that is found.
struct LiteralVector : Terminal<LiteralVector, ast::LiteralVector> {
  bool scan(Iterator& at, Iterator last, State& state, ast::LiteralVector& out) const {
    return *at == '<' && scan_components(at, last, state, out);
  }
  static bool scan_components(Iterator& at, Iterator last, State& state, ast::LiteralVector& out);
  std::string label() const { return "a vector"; }
};

struct StringLiteral : Terminal<StringLiteral, ast::String> {
  bool scan(Iterator& at, Iterator last, State& state, ast::String& out) const {
    return *at == '"' && scan_checked(at, last, state, out, after_path_word(at, last, state));
  }
  static bool scan_checked(Iterator& at, Iterator last, State& state, ast::String& out, bool path);
  static bool after_path_word(Iterator at, Iterator last, State const& state) {
    return state.path_word_end != nullptr && skip_blanks(state.path_word_end, last) == at;
  }
  std::string label() const { return "a string"; }
};

/// A string in which a backslash is one: unknown escapes are fine.
struct PathLiteral : Terminal<PathLiteral, ast::String> {
  bool scan(Iterator& at, Iterator last, State& state, ast::String& out) const {
    return *at == '"' && StringLiteral::scan_checked(at, last, state, out, true);
  }
  std::string label() const { return "a file name"; }
};

/// A name; words of the kinds in `kinds` count as one. After it must (or must not) stand `{`.
enum class Brace : std::uint8_t { Any, Follows };
struct NameOf : Terminal<NameOf, ast::Name> {
  constexpr NameOf(unsigned kinds, Brace brace, char const* what)
      : kinds_(kinds), brace_(brace), label_(what) {}
  static constexpr unsigned bit(WordKind kind) { return 1u << static_cast<unsigned>(kind); }
  bool scan(Iterator& at, Iterator last, State& state, ast::Name& out) const;
  std::string label() const { return label_; }
  unsigned kinds_;
  Brace brace_;
  char const* label_;
};

/// A name that is being declared. @throws SyntaxError E0114 for a reserved word
struct NewName : Terminal<NewName, ast::Name> {
  constexpr explicit NewName(char const* what) : label_(what) {}
  bool scan(Iterator& at, Iterator last, State& state, ast::Name& out) const;
  std::string label() const { return label_; }
  char const* label_;
};

/// A reserved word that is no operand here: `translate`, `color`, `sqr` when no '(' follows.
/// `colour_only`: of the words that may follow a colour value (`White filter .5`).
/// @throws SyntaxError E0116 for a directive's word that lacks its '#'
struct WordLiteral : Terminal<WordLiteral, ast::Word> {
  constexpr explicit WordLiteral(bool colour_only = false) : colour_only_(colour_only) {}
  bool scan(Iterator& at, Iterator last, State& state, ast::Word& out) const;
  std::string label() const { return "a word"; }
  bool colour_only_;
};

/// A lone ':' or ';', or a bracket that closes what another branch of an #if opened.
struct PunctuationLiteral : Terminal<PunctuationLiteral, ast::Punctuation> {
  bool scan(Iterator& at, Iterator, State& state, ast::Punctuation& out) const {
    bool const loose =
        (*at == '}' || *at == ')') && state.structure && state.structure->close.contains(at);
    bool const semicolon = *at == ';' && (state.bracket == 0 || state.bracket == '{');
    if (*at != ':' && !semicolon && !loose) return false;
    state.loose |= loose;
    out.symbol = *at++;
    out.span = state.span(at - 1, at);
    return true;
  }
  std::string label() const { return "':'"; }
};

constexpr unsigned plain_names = NameOf::bit(WordKind::Name);
constexpr unsigned operand_names = plain_names | NameOf::bit(WordKind::Operand);
constexpr unsigned callee_names = operand_names | NameOf::bit(WordKind::Function);
constexpr unsigned head_names =
    plain_names | NameOf::bit(WordKind::Function) | NameOf::bit(WordKind::Word);

constexpr auto mark(char c) {
  return Mark(c);
}
constexpr auto keyword(std::string_view word) {
  return Keyword(word);
}

} // namespace abbe::grammar

namespace boost::spirit::x3 {
/// The name of our parsers in messages.
template <class T>
struct get_info<T, std::enable_if_t<std::is_base_of_v<abbe::grammar::Labelled, T>>> {
  using result_type = std::string;
  std::string operator()(T const& parser) const { return parser.label(); }
};
} // namespace boost::spirit::x3
