// SPDX-License-Identifier: MIT
#include "lang/blocks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace abbe::lang {

namespace {

using geometry::Transform;

/// POV-Ray takes a scale of 0 for a slip and uses 1.
Vec3 read_scale(Reader& in) {
  Span const at = in.next_span();
  Vec3 by = in.vec3("scale");
  for (int i = 0; i < 3; ++i) {
    if (by[i] != 0) continue;
    by[i] = 1;
    in.report(Severity::Warning, "E0350", fmt::format("scale 0 in {} is taken as 1", "xyz"[i]), at);
  }
  return by;
}

Transform read_matrix(Reader& in) {
  Span const at = in.next_span();
  std::vector<double> const numbers = in.components("matrix", 12);
  double rows[12];
  std::copy_n(numbers.begin(), 12, rows);
  // As a scale of 0, POV-Ray mends a column of zeros, which gives nothing in x, y or z.
  for (std::size_t i = 0; i < 3; ++i) {
    if (rows[i] != 0 || rows[3 + i] != 0 || rows[6 + i] != 0) continue;
    rows[4 * i] = 1;
    in.report(Severity::Warning, "E0350",
              fmt::format("this matrix gives no {0}: its place for the scale of {0} is taken as 1",
                          "xyz"[i]),
              at);
  }
  if (auto matrix = Transform::matrix(rows)) return *matrix;
  in.report(Severity::Error, "E0351", "this matrix is singular: it has no inverse", at);
  return {};
}

bool read_one(Reader& in, Transform& transform);

} // namespace

void check_range(Reader& in, Transform& transform, Span at) {
  double sum = 0; // finite if all are: what overflows here is of no use either
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      sum += std::abs(transform.linear[i][j]) + std::abs(transform.inverse_linear[i][j]);
  for (int i = 0; i < 3; ++i)
    sum += std::abs(transform.offset[i]) + std::abs(transform.inverse_offset[i]);
  if (std::isfinite(sum)) return;
  in.report(Severity::Error, "E0351",
            "these transformations together are too large or too small for numbers", at);
  transform = {};
}

Transform read_transform_block(Reader& in) {
  Transform whole;
  bool inverse = false;
  while (!in.at_end()) {
    if (in.accept("inverse"))
      inverse = true;
    else if (auto named = in.accept_value<Transform>())
      whole = whole.then(*named);
    else if (!read_transform(in, whole))
      reject(in, "a transform");
  }
  return inverse ? whole.inverse() : whole;
}

bool read_transform(Reader& in, Transform& transform) {
  Span const at = in.next_span();
  if (!read_one(in, transform)) return false;
  check_range(in, transform, at);
  return true;
}

namespace {

bool read_one(Reader& in, Transform& transform) {
  if (in.accept("translate")) {
    transform = transform.then(Transform::translation(in.vec3("translation")));
  } else if (in.accept("rotate")) {
    transform = transform.then(Transform::rotation(in.vec3("rotation in degrees")));
  } else if (in.accept("scale")) {
    transform = transform.then(Transform::scaling(read_scale(in)));
  } else if (in.accept("matrix")) {
    transform = transform.then(read_matrix(in));
  } else if (in.open("transform")) {
    transform = transform.then(read_transform_block(in));
    in.close();
  } else if (in.accept("transform")) {
    if (auto named = in.accept_value<Transform>())
      transform = transform.then(*named);
    else
      reject(in, "the name of a transform");
  } else {
    return false;
  }
  return true;
}

} // namespace

} // namespace abbe::lang
