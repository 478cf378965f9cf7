// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <initializer_list>
#include <memory>
#include <utility>
#include <vector>

namespace abbe {

/// A list that is empty as a rule: it takes one pointer then, where a vector takes three.
template <class T>
class Few {
public:
  using value_type = T;
  Few() = default;
  Few(std::vector<T> items) {
    if (!items.empty()) items_ = std::make_unique<std::vector<T>>(std::move(items));
  }
  Few(std::initializer_list<T> items) : Few(std::vector<T>(items)) {}
  Few(Few const& other)
      : items_(other.items_ ? std::make_unique<std::vector<T>>(*other.items_) : nullptr) {}
  Few(Few&&) noexcept = default;
  Few& operator=(Few const& other) {
    if (this != &other) *this = Few(other);
    return *this;
  }
  Few& operator=(Few&&) noexcept = default;
  ~Few() = default;

  bool empty() const { return !items_ || items_->empty(); }
  std::size_t size() const { return items_ ? items_->size() : 0; }
  T* begin() { return items_ ? items_->data() : nullptr; }
  T* end() { return begin() + size(); }
  T const* begin() const { return items_ ? items_->data() : nullptr; }
  T const* end() const { return begin() + size(); }
  T& operator[](std::size_t i) { return (*items_)[i]; }
  T const& operator[](std::size_t i) const { return (*items_)[i]; }
  void push_back(T item) {
    if (!items_) items_ = std::make_unique<std::vector<T>>();
    items_->push_back(std::move(item));
  }
  void append(Few const& other) {
    for (std::size_t i = 0, count = other.size(); i < count; ++i) push_back(other[i]);
  }
  void clear() { items_.reset(); }

private:
  std::unique_ptr<std::vector<T>> items_;
};

} // namespace abbe
