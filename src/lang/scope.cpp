// SPDX-License-Identifier: MIT
#include "lang/scope.hpp"

namespace abbe::lang {

Scope::Scope() : names_(1), tables_(1) {}

Symbol Scope::intern(std::string_view text) {
  auto const found = index_.find(text);
  if (found != index_.end()) return found->second;
  auto const symbol = static_cast<Symbol>(names_.size());
  names_.push_back({std::string(text), {}, nullptr});
  index_.emplace(names_.back().text, symbol);
  return symbol;
}

Scope::Cell Scope::cell(Symbol symbol) const {
  auto const& bindings = names_[symbol].bindings;
  return bindings.empty() ? nullptr : bindings.back().cell;
}

Value& Scope::declare(Symbol symbol) {
  auto const& bindings = names_[symbol].bindings;
  return bindings.empty() ? declare_local(symbol, 0) : *bindings.back().cell;
}

Value& Scope::declare_local(Symbol symbol, int depth) {
  auto& bindings = names_[symbol].bindings;
  auto place = bindings.end();
  while (place != bindings.begin() && place[-1].depth > depth) --place;
  if (place != bindings.begin() && place[-1].depth == depth) return *place[-1].cell;
  auto cell = std::make_shared<Value>();
  Value& value = *cell;
  bindings.insert(place, {depth, std::move(cell)});
  tables_[static_cast<std::size_t>(depth)].push_back(symbol);
  return value;
}

void Scope::bind(Symbol symbol, Cell cell) {
  names_[symbol].bindings.push_back({depth(), std::move(cell)});
  tables_.back().push_back(symbol);
}

bool Scope::undefine(Symbol symbol) {
  auto& bindings = names_[symbol].bindings;
  if (bindings.empty()) return false;
  bindings.pop_back();
  return true;
}

void Scope::enter() {
  tables_.emplace_back();
}

void Scope::leave() {
  int const leaving = depth();
  for (Symbol const symbol : tables_.back()) {
    auto& bindings = names_[symbol].bindings;
    while (!bindings.empty() && bindings.back().depth == leaving) bindings.pop_back();
  }
  tables_.pop_back();
}

void Scope::deprecate(Symbol symbol, Deprecation how) {
  names_[symbol].deprecation = std::make_unique<Deprecation>(std::move(how));
}

std::vector<std::string_view> Scope::declared() const {
  std::vector<std::string_view> names;
  for (auto const& name : names_)
    if (!name.bindings.empty()) names.push_back(name.text);
  return names;
}

} // namespace abbe::lang
