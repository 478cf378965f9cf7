// SPDX-License-Identifier: MIT
#pragma once

#include "grammar/ast.hpp"
#include "lang/value.hpp"

#include <cstdint>
#include <deque>
#include <memory>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

namespace abbe::lang {

/// A name's number. Names that the interpreter knows itself come first (see builtins.hpp).
using Symbol = std::uint32_t;

/// The names of a run and what they stand for: POV-Ray's stack of symbol tables (one for the scene,
/// one for each include file and macro call under way), searched from the innermost outward.
///
/// Every symbol carries its own stack of bindings, so that a look-up is one access whatever the
/// depth. What a name stands for lives in a cell; a macro parameter may share the cell of its
/// argument (call by reference).
class Scope {
public:
  using Cell = std::shared_ptr<Value>;

  Scope();

  Symbol intern(std::string_view text);
  Symbol symbol(ast::Name const& name) {
    if (name.symbol == 0) name.symbol = intern(name.text);
    return name.symbol;
  }
  std::string_view text(Symbol symbol) const { return names_[symbol].text; }

  /// The innermost value of the name, nullptr when there is none.
  Value* find(Symbol symbol) {
    auto const& bindings = names_[symbol].bindings;
    return bindings.empty() ? nullptr : bindings.back().cell.get();
  }
  Cell cell(Symbol symbol) const;
  /// `#declare`: the innermost cell of that name, or else a new one in the outermost table.
  Value& declare(Symbol);
  /// `#local`: the cell in the table of that depth, made when there is none.
  Value& declare_local(Symbol, int depth);
  Value& declare_local(Symbol symbol) { return declare_local(symbol, depth()); }
  /// Binds the name in the current table to an existing cell.
  void bind(Symbol, Cell);
  /// `#undef`. @return false when the name stands for nothing
  bool undefine(Symbol);

  void enter();
  void leave();
  int depth() const { return static_cast<int>(tables_.size()) - 1; }

  /// `#declare deprecated`: the text to warn with, kept with the name.
  struct Deprecation {
    std::string message;
    bool once = false;
  };
  void deprecate(Symbol symbol, Deprecation how);
  /// What to warn with when the name is used; nullptr as a rule.
  Deprecation* deprecation(Symbol symbol) { return names_[symbol].deprecation.get(); }
  void forget_deprecation(Symbol symbol) { names_[symbol].deprecation.reset(); }

  /// Names that stand for something now, for "did you mean".
  std::vector<std::string_view> declared() const;

private:
  struct Binding {
    int depth;
    Cell cell;
  };
  struct Name {
    std::string text;
    std::vector<Binding> bindings;
    std::unique_ptr<Deprecation> deprecation;
  };

  std::deque<Name> names_; ///< index = Symbol; 0 is none
  std::unordered_map<std::string_view, Symbol> index_;
  std::vector<std::vector<Symbol>> tables_; ///< the names bound in each table
};

} // namespace abbe::lang
