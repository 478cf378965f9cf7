// SPDX-License-Identifier: MIT
#include "transport/caustics/sheet_index.hpp"

#include <algorithm>
#include <cmath>

namespace abbe::transport::caustics {
namespace {

/// How often a beam is halved at most.
constexpr int most_halvings = 12;

/// Rectangle around the nodes of a sheet: low x, high x, low y, high y.
struct Rectangle {
  std::array<double, 4> side;
  double size() const { return std::max(side[1] - side[0], side[3] - side[2]); }
};

Rectangle around(Sheet const& sheet, double share, double ahead) {
  Rectangle out{{INFINITY, -INFINITY, INFINITY, -INFINITY}};
  auto const axis = [&](auto const& at, auto const& slope, std::size_t first) {
    for (std::size_t k = 0; k < 9; ++k) {
      double const a = at[k] + ahead * slope[k], b = at[k + 9] + ahead * slope[k + 9];
      double const place = a + share * (b - a);
      out.side[first] = std::min(out.side[first], place);
      out.side[first + 1] = std::max(out.side[first + 1], place);
    }
    // And by what floats of that size are off.
    double const more =
        sheet.margin * (out.side[first + 1] - out.side[first])
        + std::ldexp(std::max(std::abs(out.side[first]), std::abs(out.side[first + 1])), -20);
    out.side[first] -= more;
    out.side[first + 1] += more;
  };
  axis(sheet.x, sheet.slope_x, 0);
  axis(sheet.y, sheet.slope_y, 2);
  return out;
}

void add_corners(Sheet const& sheet, Rectangle const& at, double ahead, geometry::Bounds& box) {
  for (std::size_t const x : {0, 1})
    for (std::size_t const y : {2, 3}) {
      Vec3 const corner =
          sheet.middle + ahead * sheet.along + at.side[x] * sheet.across + at.side[y] * sheet.up;
      box.low = glm::min(box.low, corner);
      box.high = glm::max(box.high, corner);
    }
}

bool disperses(Sheet const& sheet) {
  for (std::size_t k = 0; k < 9; ++k)
    if (sheet.x[k] != sheet.x[k + 9] || sheet.y[k] != sheet.y[k + 9]
        || sheet.slope_x[k] != sheet.slope_x[k + 9] || sheet.slope_y[k] != sheet.slope_y[k + 9])
      return true;
  return false;
}

} // namespace

/// Pieces of a beam in which light may fall on something, not much longer than wide.
/// @param ends of a piece of the spectrum @param from, to along the beam
void SheetIndex::add_pieces(Sheet const& sheet, std::uint32_t number,
                            std::array<double, 2> const& ends, double from, double to, int halvings,
                            Receivers const& receivers, std::vector<Piece>& out,
                            std::vector<geometry::Bounds>& boxes) {
  std::array<std::array<Rectangle, 2>, 2> at;
  geometry::Bounds box{Vec3(INFINITY), Vec3(-INFINITY)};
  double wide = 0, wide_begin = 0;
  for (std::size_t end = 0; end < 2; ++end)
    for (std::size_t i = 0; i < 2; ++i) {
      double const ahead = i == 0 ? from : to;
      at[end][i] = around(sheet, (ends[end] - sheet.from) / (sheet.to - sheet.from), ahead);
      add_corners(sheet, at[end][i], ahead, box);
      wide = std::max(wide, at[end][i].size());
      if (i == 0) wide_begin = std::max(wide_begin, at[end][i].size());
    }
  if (!receivers.may_be_in(box.low, box.high)) return;
  if (halvings < most_halvings && to - from > 4 * wide) {
    // A beam that is long grows wide.
    double const before = from - sheet.near + wide_begin;
    double const middle = to - from > 8 * before ? from + 4 * before : 0.5 * (from + to);
    add_pieces(sheet, number, ends, from, middle, halvings + 1, receivers, out, boxes);
    add_pieces(sheet, number, ends, middle, to, halvings + 1, receivers, out, boxes);
    return;
  }
  Piece piece;
  piece.sheet = number;
  piece.begin = from;
  piece.per_length = to > from ? 1 / (to - from) : 0;
  piece.from = ends[0];
  piece.to = ends[1];
  for (std::size_t end = 0; end < 2; ++end)
    for (std::size_t k = 0; k < 4; ++k) {
      piece.side[end][k] = static_cast<float>(at[end][0].side[k]);
      piece.more[end][k] = static_cast<float>(at[end][1].side[k] - at[end][0].side[k]);
    }
  out.push_back(piece);
  boxes.push_back(box);
}

bool SheetIndex::Piece::may_hold(Vec3 const& place, double& first, double& last) const {
  // Sides between two distances: what bounds straight lines there is a chord of what bounds them
  // at the ends.
  auto const share = static_cast<float>((place.z - begin) * per_length);
  if (!(share >= -0x1p-10F && share <= 1 + 0x1p-10F)) return false;
  float const low_at[4] = {static_cast<float>(place.x), -static_cast<float>(place.x),
                           static_cast<float>(place.y), -static_cast<float>(place.y)};
  float begin_of = 0, end_of = 1;
  bool outside = false;
  for (std::size_t k = 0; k < 4; ++k) {
    // How far inside of the side the place is, at both wavelengths.
    float const sign = k % 2 == 0 ? 1.0F : -1.0F;
    float const a = low_at[k] - sign * (side[0][k] + share * more[0][k]),
                b = low_at[k] - sign * (side[1][k] + share * more[1][k]);
    float const zero = a / (a - b);
    outside = outside || (a < 0 && b < 0);
    if (a < 0 && b >= 0) begin_of = std::max(begin_of, zero);
    if (a >= 0 && b < 0) end_of = std::min(end_of, zero);
  }
  if (outside || end_of < begin_of) return false;
  first = from + begin_of * (to - from);
  last = from + end_of * (to - from);
  return true;
}

void SheetIndex::build(std::vector<geometry::Bounds> const& boxes, Slice& slice) {
  if (boxes.empty()) return;
  geometry::BvhSpaceFinder finder;
  std::vector<double> sizes;
  for (auto const& box : boxes) {
    finder.add(box.low, box.high);
    sizes.push_back(glm::length(box.high - box.low));
  }
  std::ranges::nth_element(sizes, sizes.begin() + static_cast<std::ptrdiff_t>(sizes.size() / 2));
  slice.grain = sizes[sizes.size() / 2];
  geometry::BvhSpace const space = finder.space();
  std::vector<geometry::BvhBox> in_floats;
  in_floats.reserve(boxes.size());
  for (std::uint32_t k = 0; k < boxes.size(); ++k)
    in_floats.push_back(space.box(boxes[k].low, boxes[k].high, k));
  slice.bvh = geometry::Bvh(space, std::move(in_floats));
}

SheetIndex::SheetIndex(std::vector<Sheet> sheets, Receivers const& receivers)
    : sheets_(std::move(sheets)) {
  std::vector<geometry::Bounds> whole;
  std::array<std::vector<geometry::Bounds>, slices> sliced;
  for (std::uint32_t k = 0; k < sheets_.size(); ++k) {
    Sheet const& sheet = sheets_[k];
    if (!disperses(sheet)) {
      add_pieces(sheet, k, {sheet.from, sheet.to}, sheet.near, sheet.far, 0, receivers,
                 whole_.pieces, whole);
      continue;
    }
    for (std::size_t slice = 0; slice < slices; ++slice) {
      double const from = std::max(sheet.from, static_cast<double>(slice) / slices),
                   to = std::min(sheet.to, static_cast<double>(slice + 1) / slices);
      if (from < to)
        add_pieces(sheet, k, {from, to}, sheet.near, sheet.far, 0, receivers, sliced_[slice].pieces,
                   sliced[slice]);
    }
  }
  build(whole, whole_);
  for (std::size_t slice = 0; slice < slices; ++slice) build(sliced[slice], sliced_[slice]);
}

void SheetIndex::look(Slice const& slice, std::span<Want const> wants,
                      std::span<std::uint32_t const> of,
                      std::vector<std::vector<Over>>& out) const {
  if (slice.pieces.empty()) return;
  for (std::size_t first = 0, last = 0; first < of.size(); first = last) {
    Vec3 low = wants[of[first]].point, high = low;
    for (last = first + 1; last < of.size(); ++last) {
      Vec3 const& next = wants[of[last]].point;
      Vec3 const lower = glm::min(low, next), higher = glm::max(high, next);
      if (!(glm::length(higher - lower) <= slice.grain)) break;
      low = lower;
      high = higher;
    }
    geometry::each_meeting(slice.bvh, slice.bvh.space().box(low, high, 0), [&](std::uint32_t k) {
      Piece const& piece = slice.pieces[k];
      Sheet const& sheet = sheets_[piece.sheet];
      for (std::uint32_t const at : of.subspan(first, last - first)) {
        Vec3 const off = wants[at].point - sheet.middle;
        Over over{piece.sheet, 0, 0};
        if (piece.may_hold(
                {glm::dot(off, sheet.across), glm::dot(off, sheet.up), glm::dot(off, sheet.along)},
                over.from, over.to))
          out[at].push_back(over);
      }
    });
  }
}

void SheetIndex::find(std::span<Want const> wants, std::vector<std::vector<Over>>& out) const {
  if (out.size() < wants.size()) out.resize(wants.size());
  std::vector<std::uint32_t> of(wants.size());
  for (std::uint32_t k = 0; k < wants.size(); ++k) {
    out[k].clear();
    of[k] = k;
  }
  look(whole_, wants, of, out);
  auto const slice_of = [](double at) {
    return static_cast<std::size_t>(std::clamp(static_cast<int>(at * slices), 0, slices - 1));
  };
  for (std::size_t slice = 0; slice < slices; ++slice) {
    of.clear();
    for (std::uint32_t k = 0; k < wants.size(); ++k)
      if (slice_of(wants[k].from) <= slice && slice <= slice_of(wants[k].to)
          && wants[k].from <= wants[k].to)
        of.push_back(k);
    look(sliced_[slice], wants, of, out);
  }
  for (std::uint32_t k = 0; k < wants.size(); ++k) {
    std::vector<Over>& own = out[k];
    std::ranges::sort(own, {}, &Over::sheet);
    // Pieces of one sheet are one.
    std::size_t count = 0;
    for (Over const& over : own) {
      if (count > 0 && own[count - 1].sheet == over.sheet) {
        own[count - 1].from = std::min(own[count - 1].from, over.from);
        own[count - 1].to = std::max(own[count - 1].to, over.to);
      } else {
        own[count++] = over;
      }
    }
    own.resize(count);
  }
}

} // namespace abbe::transport::caustics
