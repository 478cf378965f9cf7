// SPDX-License-Identifier: MIT
#include "lang/deferral.hpp"

#include "lang/interpreter.hpp"

#include <algorithm>
#include <utility>

namespace abbe::lang {

Deferral::Deferral(Interpreter& in) : in_(in), outer_(std::exchange(in.deferral, this)) {}

Deferral::~Deferral() {
  in_.deferral = outer_;
}

void Deferral::keep(Diagnostic diagnostic) {
  auto const same = [&](Diagnostic const& other) {
    return other.span.source == diagnostic.span.source && other.span.begin == diagnostic.span.begin
           && other.message == diagnostic.message;
  };
  if (std::none_of(kept_.begin(), kept_.end(), same)) kept_.push_back(std::move(diagnostic));
}

void Interpreter::report(Severity severity, std::string_view code, std::string message, Span span,
                         std::vector<Diagnostic::Note> notes) {
  wrong_since_asked_ |= severity == Severity::Error && !code.starts_with("E09");
  auto chain = reader.chain();
  notes.insert(notes.end(), std::make_move_iterator(chain.begin()),
               std::make_move_iterator(chain.end()));
  keep_or_add({std::string(code), severity, span, std::move(message), std::move(notes)});
}

void Interpreter::use(Few<Diagnostic> const& deferred, Span at) {
  for (Diagnostic told : deferred) {
    if (at.valid()) told.notes.push_back({at, "used here"});
    if (!deferral) {
      auto const chain = reader.chain();
      told.notes.insert(told.notes.end(), chain.begin(), chain.end());
    }
    keep_or_add(std::move(told));
  }
}

void Interpreter::keep_or_add(Diagnostic diagnostic) {
  if (deferral && (diagnostic.code == "E0901" || diagnostic.code == "E0903"))
    deferral->keep(std::move(diagnostic));
  else if (diagnostic.code == "E0903")
    state.not_rendered.try_emplace(std::string(diagnostic.message), std::move(diagnostic));
  else
    add(std::move(diagnostic));
}

void Interpreter::tell_not_rendered() {
  for (auto& [message, told] : std::exchange(state.not_rendered, {})) {
    if (state.scene.settings.effects.strict) told.severity = Severity::Error;
    add(std::move(told));
  }
}

} // namespace abbe::lang
