// SPDX-License-Identifier: MIT
#pragma once

#include "base/diagnostic.hpp"
#include "base/few.hpp"
#include "base/source.hpp"

namespace abbe::lang {

class Interpreter;

/// What is not supported yet (E0901) is an error where it is used, not where it is declared, and
/// what is not rendered yet (E0903) is told there: while a Deferral lives, such messages are kept
/// for the value that is being declared (Value::deferred). Interpreter::use() tells them when the
/// value is used: at once in the scene itself, else they are kept for the value that it becomes
/// part of.
class Deferral {
public:
  explicit Deferral(Interpreter&);
  Deferral(Deferral const&) = delete;
  Deferral& operator=(Deferral const&) = delete;
  ~Deferral();

  /// Keeps the message, unless it is kept already.
  void keep(Diagnostic);
  Few<Diagnostic> take() { return std::move(kept_); }

private:
  Interpreter& in_;
  Deferral* outer_;
  Few<Diagnostic> kept_;
};

} // namespace abbe::lang
