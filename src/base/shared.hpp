// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <utility>

namespace abbe {

/// A value that its copies share until one of them is changed: a copy costs a pointer. Reading one
/// that was never given a value reads a T{}.
///
/// What is not const gives out a T that may be changed, and first makes it its own where it is
/// shared: read through `Shared const&`. Not to be changed while another thread copies or reads it.
template <class T>
class Shared {
public:
  Shared() = default;
  Shared(T value) : value_(std::make_shared<T>(std::move(value))) {}
  /// Shares what a value of the language holds. Made by make_shared<T>: not const itself.
  Shared(std::shared_ptr<T const> value) : value_(std::const_pointer_cast<T>(std::move(value))) {}

  bool has_value() const { return value_ != nullptr; }
  explicit operator bool() const { return has_value(); }
  T const& operator*() const { return value_ ? *value_ : none(); }
  T const* operator->() const { return &**this; }
  T& operator*() { return own(); }
  T* operator->() { return &own(); }
  T& own() {
    if (!value_)
      value_ = std::make_shared<T>();
    else if (value_.use_count() > 1)
      value_ = std::make_shared<T>(*value_);
    return *value_;
  }
  void reset() { value_.reset(); }
  /// Have both the value that the other has?
  bool shares(Shared const& other) const { return value_ && value_ == other.value_; }
  /// Equal for those that share; null for none.
  std::shared_ptr<T const> held() const { return value_; }

private:
  static T const& none() {
    static T const value{};
    return value;
  }
  std::shared_ptr<T> value_;
};

} // namespace abbe
