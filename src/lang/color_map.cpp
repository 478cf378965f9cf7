// SPDX-License-Identifier: MIT
#include "lang/pattern.hpp"

#include <fmt/format.h>

namespace abbe::lang {

namespace {

using scene::Pigment;

std::shared_ptr<Pigment const> plain(scene::Colour colour, Span span) {
  auto pigment = std::make_shared<Pigment>();
  pigment->span = span;
  pigment->colour = std::move(colour);
  return pigment;
}

scene::Colour read_entry_colour(Reader& in) {
  if (auto colour = accept_colour(in)) return *colour;
  in.report(Severity::Error, "E0250", "expected a colour in this map entry", in.next_span());
  return {};
}

/// `v colour` or the old `v1 v2 color c1 color c2`.
void read_color_entry(Reader& in, std::vector<Pigment::Entry>& entries) {
  Span const span = in.next_span();
  double const value = in.number("map value");
  // A second number must be looked at before it is known to be a colour's name or not.
  if (in.has_value()) {
    Span const at = in.next_span();
    Numeric const second = in.numeric("map value or colour");
    if (!second.colour && second.size == 1 && !in.at_end()) {
      entries.push_back({value, plain(read_entry_colour(in), span)});
      entries.push_back({second.scalar(), plain(read_entry_colour(in), span)});
      return;
    }
    if (!second.colour)
      in.report(Severity::Error, "E0354",
                "a colour must begin here with 'rgb', 'color' or a colour's name, not with a bare "
                "number or vector",
                at);
    Numeric const five = second.promoted(5);
    scene::Colour start{Vec3(five.c[0], five.c[1], five.c[2]), five.c[3], five.c[4], nullptr};
    entries.push_back({value, plain(read_colour_parts(in, std::move(start)), span)});
    return;
  }
  entries.push_back({value, plain(read_entry_colour(in), span)});
}

template <class ReadEntry>
std::vector<Pigment::Entry> read_map(Reader& in, std::string_view what,
                                     ReadEntry const& read_entry) {
  std::vector<Pigment::Entry> entries;
  if (auto named = in.accept_value<MapValue>()) entries = named->entries;
  read_entries(in, what, entries, read_entry);
  return entries;
}

} // namespace

std::vector<Pigment::Entry> read_color_map(Reader& in) {
  auto entries = read_map(in, "a color_map", read_color_entry);
  make_ascending(entries, in, [](auto const& entry) { return entry.pigment->span; });
  return entries;
}

std::vector<Pigment::Entry> read_pigment_map(Reader& in, PigmentWords const& words) {
  return read_map(in, fmt::format("a {}", words.map),
                  [&](Reader& items, std::vector<Pigment::Entry>& entries) {
                    double const value = read_entry_value(items);
                    entries.push_back({value, read_pigment_item(items, words)});
                  });
}

} // namespace abbe::lang
