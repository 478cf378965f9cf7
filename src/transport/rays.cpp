// SPDX-License-Identifier: MIT
#include "transport/rays.hpp"

#include <algorithm>

namespace abbe::transport {

void Rays::grow(std::size_t room) {
  room_ = std::max<std::size_t>({room, 2 * room_, 64});
  double** const views[] = {&origin.x,       &origin.y,       &origin.z,
                            &direction.x,    &direction.y,    &direction.z,
                            &origin_error.x, &origin_error.y, &origin_error.z};
  for (std::size_t i = 0; i < std::size(views); ++i) {
    vectors_[i].resize(room_);
    *views[i] = vectors_[i].data();
  }
  start.resize(room_);
  stack.resize(room_);
  slot.resize(room_);
  channel.resize(room_);
  tooth.resize(room_);
  level.resize(room_);
  light.resize(room_ * kind_.size());
  if (kind_.listed()) channels.resize(room_ * kind_.size());
  if (fields_.travelled) travelled.resize(room_);
  if (fields_.path) path.resize(room_);
  if (fields_.rest) rest.resize(room_);
}

std::size_t Rays::add(std::size_t some) {
  std::size_t const first = count_;
  count_ += some;
  if (count_ > room_) grow(count_);
  return first;
}

void Rays::put(std::size_t to, Rays const& from, std::size_t k) {
  std::size_t const n = kind_.size();
  origin.set(to, from.origin.get(k));
  direction.set(to, from.direction.get(k));
  origin_error.set(to, from.origin_error.get(k));
  start[to] = from.start[k];
  stack[to] = from.stack[k];
  slot[to] = from.slot[k];
  channel[to] = from.channel[k];
  tooth[to] = from.tooth[k];
  level[to] = from.level[k];
  std::copy_n(from.light_of(k), n, light_of(to));
  if (kind_.listed()) std::copy_n(from.channels.data() + k * n, n, channels.data() + to * n);
  if (fields_.travelled) travelled[to] = from.travelled[k];
  if (fields_.path) path[to] = from.path[k];
  if (fields_.rest) rest[to] = from.rest[k];
}

} // namespace abbe::transport
