// SPDX-License-Identifier: MIT
#include "lang/block_function.hpp"

#include "lang/interpreter.hpp"
#include "lang/spline.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <utility>

namespace abbe::lang {
namespace {

using Arguments = std::span<double const>;

Vec3 point_of(Arguments a) {
  return {a[0], a[1], a[2]};
}

Numeric colour_of(scene::Colour const& colour) {
  Numeric n;
  n.size = 5;
  n.colour = true;
  n.c = {colour.rgb.x, colour.rgb.y, colour.rgb.z, colour.filter, colour.transmit};
  return n;
}

/// Of a pigment that mixes its entries by their weights.
Numeric average_at(scene::Pigment const& pigment, Vec3 const& inner) {
  Numeric out = colour_of({});
  double sum = 0;
  for (auto const& entry : pigment.entries) sum += entry.value;
  for (auto const& entry : pigment.entries) {
    Numeric const own = colour_at(*entry.pigment, inner);
    for (std::size_t i = 0; i < 5; ++i) out.c[i] += entry.value / sum * own.c[i];
  }
  return out;
}

} // namespace

Numeric colour_at(scene::Pigment const& pigment, Vec3 const& point) {
  if (!pigment.pattern) return colour_of(pigment.colour);
  std::vector<double> values;
  for (auto const& entry : pigment.entries) values.push_back(entry.value);
  Vec3 const inner = pigment.pattern->place(point);
  auto const at = [&](int i) {
    return colour_at(*pigment.entries[static_cast<std::size_t>(i)].pigment, inner);
  };
  if (pigment.pattern->pattern->has_colours()) {
    texture::PatternColour const own = pigment.pattern->pattern->colour_at(inner);
    return colour_of({own.rgb, own.filter, own.transmit, nullptr});
  }
  if (pigment.pattern->pattern->averages()) return average_at(pigment, inner);
  auto const position = texture::look_up(values, pigment.pattern->value(inner));
  Numeric colour = at(position.first);
  if (position.weight == 0) return colour;
  Numeric const second = at(position.second);
  for (std::size_t i = 0; i < 5; ++i) colour.c[i] += position.weight * (second.c[i] - colour.c[i]);
  return colour;
}

namespace {

bool has_spectrum(scene::Pigment const& pigment) {
  return pigment.colour.spectrum || std::ranges::any_of(pigment.entries, [](auto const& entry) {
           return has_spectrum(*entry.pigment);
         });
}

/// Widens the bounds by those of a pigment's colours and their parts.
void bound(scene::Pigment const& pigment, double& least, double& most) {
  if (pigment.pattern && pigment.pattern->pattern->has_colours()) {
    least = -std::numeric_limits<double>::infinity();
    most = -least;
    return;
  }
  for (auto const& entry : pigment.entries) bound(*entry.pigment, least, most);
  if (pigment.pattern) return;
  auto const& [rgb, filter, transmit, spectrum] = pigment.colour;
  for (double const part : {rgb.x, rgb.y, rgb.z, filter, transmit}) {
    least = std::min(least, part);
    most = std::max(most, part);
  }
}

void read_pigment_function(Reader& in, FunctionValue& out) {
  scene::Pigment pigment = default_texture(in, in.block_span()).pigment;
  read_pigment(in, pigment);
  if (has_spectrum(pigment)) out.unsupported = "a function of a spectrum is not supported yet";
  out.block = [pigment](Arguments a) { return colour_at(pigment, point_of(a)); };
  double least = 0, most = 0;
  bound(pigment, least, most);
  out.least = least - 1e-9;
  out.most = most + 1e-9;
}

void read_pattern_function(Reader& in, FunctionValue& out) {
  scene::Pigment pigment;
  read_pigment(in, pigment);
  if (!pigment.pattern) return;
  out.block = [pattern = pigment.pattern](Arguments a) {
    return scalar_of(pattern->evaluate(point_of(a)));
  };
  constexpr double past = 1e-4; // values go up to 1.00001, which waves turn round
  out.least = -past;
  out.most = std::max(1, pigment.pattern->pattern->list_size() - 1) + past;
  if (pigment.pattern->modifiers.wave == texture::Wave::Poly) {
    out.least = -std::numeric_limits<double>::infinity();
    out.most = std::numeric_limits<double>::infinity();
  }
}

void read_any(Reader& in, std::string_view head, FunctionValue& out) {
  out.vector = head != "pattern";
  if (head == "pigment") {
    read_pigment_function(in, out);
  } else if (head == "pattern") {
    read_pattern_function(in, out);
  } else if (head == "transform") {
    out.block = [t = read_transform_block(in)](Arguments a) {
      return vector_of(t.point(point_of(a)));
    };
  } else if (head == "spline") {
    out.parameters = 1;
    out.block = [s = read_spline(in)](Arguments a) { return s->at(a[0], s->kind); };
  } else {
    out.unsupported = fmt::format("a function made of '{} {{ ... }}' is not supported yet", head);
    while (!in.at_end()) in.skip();
  }
}

} // namespace

void read_block_function(Reader& in, FunctionValue& out) {
  std::string const head(in.next_word());
  Span const span = in.next_span();
  Deferral deferral(in.interpreter());
  in.open_any();
  read_any(in, head, out);
  in.close();
  Few<Diagnostic> const deferred = deferral.take();
  if (!deferred.empty())
    out.unsupported = fmt::format("{}, which this function is made of", deferred[0].message);
  else if (!out.block && out.unsupported.empty())
    in.report(Severity::Error, "E0318", "expected a pattern that this function is made of", span);
}

std::optional<int> part_of(std::string_view member) {
  constexpr std::pair<std::string_view, int> parts[] = {
      {"x", 0},        {"y", 1},     {"z", 2},     {"t", 3},    {"u", 0},
      {"v", 1},        {"red", 0},   {"green", 1}, {"blue", 2}, {"filter", 3},
      {"transmit", 4}, {"gray", -1}, {"grey", -1}};
  auto const* const found =
      std::ranges::find(parts, member, &std::pair<std::string_view, int>::first);
  if (found == std::end(parts)) return std::nullopt;
  return found->second;
}

double take_part(Numeric const& n, int part) {
  Numeric const all = n.promoted(5);
  if (part < 0) return 0.297 * all.c[0] + 0.589 * all.c[1] + 0.114 * all.c[2];
  return all.c[static_cast<std::size_t>(part)];
}

} // namespace abbe::lang
