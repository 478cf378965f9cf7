// SPDX-License-Identifier: MIT
#include "geometry/shapes/polygon.hpp"
#include "geometry/shapes/prism.hpp"
#include "geometry/shapes/reading.hpp"
#include "geometry/shapes/spline_prism.hpp"

#include <algorithm>

namespace abbe::geometry {

namespace {

/// The points that are furthest apart where all are on a line.
std::pair<Vec2, Vec2> ends_of(Prism::Contour const& contour) {
  auto const before = [](Vec2 const& a, Vec2 const& b) {
    return a.x < b.x || (a.x == b.x && a.y < b.y);
  };
  auto const [a, b] = std::minmax_element(contour.begin(), contour.end(), before);
  return {*a, *b};
}

/// But for the rounding of decimal places.
bool on_a_line(Prism::Contour const& contour) {
  auto const [a, b] = ends_of(contour);
  Vec2 const along = b - a;
  double const most = 0x1p-40 * glm::dot(along, along);
  return std::all_of(contour.begin(), contour.end(), [&, from = a](Vec2 const& p) {
    Vec2 const to = p - from;
    return std::fabs(lane::difference_of_products(along.x, to.y, along.y, to.x)) <= most;
  });
}

/// A prism without a volume, as POV-Ray draws it: its outlines where its heights are the same, else
/// a wall where the points of its one outline are on a line.
std::optional<PlacedShape> flat_prism(std::vector<Prism::Contour> const& contours, double y1,
                                      double y2, bool open) {
  std::vector<std::vector<Vec3>> outlines;
  if (y1 == y2 && !open) {
    for (Prism::Contour const& contour : contours)
      for (auto& outline = outlines.emplace_back(); Vec2 const& p : contour)
        outline.push_back({p.x, y1, p.y});
  } else if (y1 != y2 && contours.size() == 1) {
    auto const [a, b] = ends_of(contours[0]);
    outlines = {{{a.x, y1, a.y}, {b.x, y1, b.y}, {b.x, y2, b.y}, {a.x, y2, a.y}}};
  }
  return make_polygon(outlines, Vec3(0, 1, 0));
}

/// What the words before the numbers say.
struct PrismKind {
  SplineKind spline = SplineKind::Linear;
  bool conic = false;
  int least_points = 3;
};

PrismKind read_kind(Parameters& parameters) {
  static constexpr SplineWord words[] = {{"linear_spline", SplineKind::Linear, 3},
                                         {"quadratic_spline", SplineKind::Quadratic, 5},
                                         {"cubic_spline", SplineKind::Cubic, 6},
                                         {"bezier_spline", SplineKind::Bezier, 4}};
  PrismKind kind;
  for (;;) {
    if (SplineWord const* const word = accept_spline(parameters, words)) {
      kind.spline = word->kind;
      kind.least_points = word->least_points;
    } else if (parameters.accept("linear_sweep")) {
      kind.conic = false;
    } else if (parameters.accept("conic_sweep")) {
      kind.conic = true;
    } else {
      return kind;
    }
  }
}

/// Outlines of straight lines, each closed by its first point; the last one closes by itself.
std::vector<Prism::Contour> contours_of(std::vector<Vec2> const& points) {
  std::vector<Prism::Contour> contours(1);
  bool closed = false;
  for (Vec2 const& point : points) {
    if (closed) contours.emplace_back();
    Prism::Contour& contour = contours.back();
    closed = !contour.empty() && contour.front() == point;
    if (!closed) contour.push_back(point);
  }
  return contours;
}

Outline pieces_of(SplineKind kind, std::vector<Vec2> const& points, std::size_t from,
                  std::size_t to) {
  std::vector<std::array<double, 2>> plain;
  for (std::size_t i = from; i < to; ++i) plain.push_back({points[i].x, points[i].y});
  return spline_pieces<2>(kind, plain);
}

/// Outlines of curves. A quadratic or cubic one has a point before its first that gives a slope, a
/// cubic one also one after its last; each ends where its first point comes again.
/// @return empty: one does not end
std::vector<Outline> outlines_of(SplineKind kind, std::vector<Vec2> const& points) {
  std::vector<Outline> outlines;
  if (kind == SplineKind::Linear) {
    for (Prism::Contour contour : contours_of(points)) {
      contour.push_back(contour.front());
      outlines.push_back(pieces_of(kind, contour, 0, contour.size()));
    }
    return outlines;
  }
  bool const bezier = kind == SplineKind::Bezier;
  std::size_t const before = bezier ? 0 : 1, after = kind == SplineKind::Cubic ? 1 : 0;
  for (std::size_t from = 0; from < points.size();) {
    std::size_t const first = from + before;
    std::size_t last = first;
    bool closed = false;
    while (!closed && last + (bezier ? 3 : 1) < points.size()) {
      // A piece of a Bezier spline begins where the one before it ended.
      if (bezier && last > first && points[last] != points[last - 1]) return {};
      last += bezier ? 3 : 1;
      closed = points[last] == points[first];
      if (bezier && !closed) ++last;
    }
    std::size_t const end = last + after + 1;
    if (!closed || end > points.size()) return {};
    outlines.push_back(pieces_of(kind, points, from, end));
    from = end;
  }
  return outlines;
}

std::optional<PlacedShape> curved_prism(Parameters& parameters, PrismKind const& kind,
                                        std::vector<Vec2> const& points, double y1, double y2,
                                        bool open) {
  auto outlines = outlines_of(kind.spline, points);
  if (outlines.empty()) {
    // POV-Ray refuses the others, too.
    constexpr std::string_view what = "the outlines of this prism are not closed: each must come "
                                      "back to its first point";
    if (kind.spline == SplineKind::Bezier)
      return left_out(parameters, "E0633", std::string(what) + "; it is not drawn");
    parameters.report(Severity::Error, "E0633", what);
    return std::nullopt;
  }
  auto const sweep = kind.conic ? SplinePrism::Sweep::Conic : SplinePrism::Sweep::Linear;
  auto prism = make_spline_prism(std::move(outlines), sweep, y1, y2, open);
  if (!prism)
    return left_out(parameters, "E0609",
                    "a prism whose outlines have no area, or whose numbers are out of range, is "
                    "not drawn");
  if (!prism->shape->solid()) {
    if (open) return left_out(parameters, "E0609", "a prism without walls and lids is not drawn");
    parameters.report(Severity::Warning, "E0609",
                      "this prism is flat: it is drawn as a patch and has no inside");
  }
  return prism;
}

} // namespace

std::optional<PlacedShape> read_prism(Parameters& parameters) {
  PrismKind const kind = read_kind(parameters);
  double const y1 = parameters.number("first height"), y2 = parameters.number("second height");
  auto const points = read_points(parameters, kind.least_points);
  if (!points) return std::nullopt;
  if (kind.spline == SplineKind::Bezier && points->size() % 4 != 0) {
    parameters.report(Severity::Error, "E0623", "a bezier_spline has four points for each piece");
    return std::nullopt;
  }
  bool open = false;
  for (;;) {
    if (auto const flag = parameters.flag("open"))
      open = *flag;
    else if (!parameters.flag("sturm"))
      break;
  }
  if (kind.spline != SplineKind::Linear || kind.conic)
    return curved_prism(parameters, kind, *points, y1, y2, open);
  auto contours = contours_of(*points);
  if (y1 == y2 || std::all_of(contours.begin(), contours.end(), on_a_line)) {
    auto flat = flat_prism(contours, y1, y2, open);
    if (!flat) return left_out(parameters, "E0609", "a prism without walls and lids is not drawn");
    parameters.report(Severity::Warning, "E0609",
                      "this prism is flat: it is drawn as a patch and has no inside");
    return flat;
  }
  return or_report(make_prism(std::move(contours), y1, y2, open), parameters, "E0609",
                   "a prism needs finite heights and outlines of three or more points");
}

} // namespace abbe::geometry
