// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <memory>
#include <utility>
#include <vector>

namespace abbe {

/// A list that its copies share until one of them is changed: a copy costs a pointer. What is not
/// const gives out items that may be changed, and first makes the list its own where it is shared:
/// read through `SharedList const&`. Not to be changed while another thread copies or reads it.
template <class T>
class SharedList {
public:
  using value_type = T;
  SharedList() = default;
  SharedList(std::vector<T> items) {
    if (!items.empty()) items_ = std::make_shared<std::vector<T>>(std::move(items));
  }

  bool empty() const { return !items_ || items_->empty(); }
  std::size_t size() const { return items_ ? items_->size() : 0; }
  T const* data() const { return items_ ? items_->data() : nullptr; }
  T const* begin() const { return data(); }
  T const* end() const { return data() + size(); }
  T const& operator[](std::size_t i) const { return (*items_)[i]; }
  T const& front() const { return items_->front(); }
  T const& back() const { return items_->back(); }
  T* begin() { return items_ ? own().data() : nullptr; }
  T* end() { return items_ ? own().data() + items_->size() : nullptr; }
  T& operator[](std::size_t i) { return own()[i]; }
  void push_back(T item) { own().push_back(std::move(item)); }
  void clear() { items_.reset(); }

  /// Equal for lists that share; null for an empty one.
  void const* id() const { return items_.get(); }
  /// Has another list the same items?
  bool shares() const { return items_.use_count() > 1; }

private:
  std::vector<T>& own() {
    if (!items_)
      items_ = std::make_shared<std::vector<T>>();
    else if (items_.use_count() > 1)
      items_ = std::make_shared<std::vector<T>>(*items_);
    return *items_;
  }
  std::shared_ptr<std::vector<T>> items_;
};

} // namespace abbe
