// SPDX-License-Identifier: MIT
#include "lang/blocks.hpp"
#include "lang/libraries.hpp"
#include "lang/pairs.hpp"
#include "optics/glass_builder.hpp"

#include <fmt/format.h>

#include <limits>

namespace abbe::lang {

namespace {

using optics::GlassBuilder;
using optics::GlassPtr;

/// Stands for a glass that could not be made, which was reported.
GlassPtr placeholder() {
  auto glass = GlassBuilder("placeholder").constant(1.5).build();
  ABBE_ASSERT(glass.ok());
  return *glass;
}

std::span<double const> components_of(Numeric const& value) {
  return {value.c.data(), value.size};
}

bool open_headless(Reader& in) {
  return in.next() == Next::Block && in.next_word().empty() && in.open_any();
}

/// `formula 2 { c0, c1, ... }`
void read_formula(Reader& in, GlassBuilder& builder) {
  int const id = in.integer("number of the formula", 1, 9);
  if (!open_headless(in)) {
    in.report(Severity::Error, "E0250", "expected the coefficients in braces after 'formula n'",
              in.next_span());
    return;
  }
  std::vector<double> coefficients;
  while (in.has_value()) coefficients.push_back(in.number("coefficient"));
  in.close();
  builder.formula(id, std::move(coefficients));
}

/// The ways to say how the index depends on wavelength.
bool read_model(Reader& in, GlassBuilder& builder) {
  if (in.accept("sellmeier")) {
    Numeric const b = in.numeric("B1, B2, B3");
    Numeric const c = in.numeric("C1, C2, C3 in um^2");
    builder.sellmeier(components_of(b), components_of(c));
  } else if (in.accept("schott")) {
    builder.schott(in.components("a0 to a5", 6));
  } else if (in.accept("cauchy")) {
    builder.cauchy(components_of(in.numeric("A, B, C")));
  } else if (in.accept("abbe")) {
    double const nd = in.number("nd");
    builder.abbe(nd, in.number("Vd"));
  } else if (in.accept("formula")) {
    read_formula(in, builder);
  } else if (in.open("samples")) {
    builder.samples(read_pairs(in, "wavelength in um", "index"));
    in.close();
  } else {
    return false;
  }
  return true;
}

bool read_absorption(Reader& in, GlassBuilder& builder) {
  if (in.accept("transmittance")) {
    double const thickness_mm = in.number("thickness in mm");
    if (!open_headless(in)) {
      in.report(Severity::Error, "E0250",
                "expected rows [wavelength in um, transmittance] in braces", in.next_span());
      return true;
    }
    builder.transmittance(thickness_mm, read_pairs(in, "wavelength in um", "transmittance"));
    in.close();
  } else if (in.open("k")) {
    builder.extinction(read_pairs(in, "wavelength in um", "extinction coefficient"));
    in.close();
  } else if (in.accept("absorption")) {
    if (!in.boolean_or(true)) builder.clear();
  } else {
    return false;
  }
  return true;
}

/// What is printed in catalogues beside the data.
bool read_remarks(Reader& in, GlassBuilder& builder, double& nd, double& vd) {
  if (in.accept("nd"))
    nd = in.number("nd");
  else if (in.accept("Vd"))
    vd = in.number("Vd");
  else if (in.accept("status"))
    builder.status(in.string("status"));
  else if (in.accept("medium"))
    builder.medium(in.string("medium"));
  else if (in.accept("category") || in.accept("reference") || in.accept("tags"))
    in.string("remark");
  else
    return false;
  return true;
}

GlassPtr find_in_files(SceneState const& state, std::string_view name) {
  // The last one read wins, as with #declare.
  for (auto i = state.file_glasses.rbegin(); i != state.file_glasses.rend(); ++i)
    if ((*i)->full_name() == name || (*i)->name() == name) return *i;
  return nullptr;
}

/// The content of a glass that is given by data. Errors are reported; then a placeholder. What is
/// doubtful gets a warning unless it comes out of the catalogue.
GlassPtr read_definition(Reader& in, GlassBuilder builder, Span at, bool catalogued) {
  double nd = std::numeric_limits<double>::quiet_NaN();
  double vd = nd;
  bool rejected = false;
  while (!in.at_end()) {
    if (in.accept("range")) {
      double const lo_um = in.number("lower end of the range in um");
      builder.range_um(lo_um, in.number("upper end of the range in um"));
    } else if (!read_model(in, builder) && !read_absorption(in, builder)
               && !read_remarks(in, builder, nd, vd)) {
      if (!reject_unquoted_glass(in)) reject(in, "a glass item");
      rejected = true;
    }
  }
  builder.printed(nd, vd);
  auto glass = builder.build();
  if (glass) {
    if (!catalogued)
      for (auto const& doubt : builder.doubts(**glass))
        in.report(Severity::Warning, "E0423", doubt, at);
    return *glass;
  }
  if (rejected) return placeholder(); // what was meant is not known
  in.report(Severity::Error, glass.error().code, glass.error().message, at);
  return placeholder();
}

/// `glass { Crown absorption off }`: a glass that exists, changed.
GlassPtr read_changes(Reader& in, GlassPtr glass) {
  while (!in.at_end()) {
    if (in.accept("absorption")) {
      if (!in.boolean_or(true)) glass = glass->without_absorption();
    } else {
      reject(in, "'absorption off', which alone changes a glass");
    }
  }
  return glass;
}

/// "; did you mean 'FLINT-2'?" out of the AGF files, or "".
std::string nearest_in_files(SceneState const& state, std::string_view name) {
  std::vector<std::string> full;
  std::vector<std::string_view> candidates;
  for (auto const& glass : state.file_glasses) full.push_back(glass->full_name());
  for (auto const& glass : state.file_glasses) candidates.push_back(glass->name());
  candidates.insert(candidates.end(), full.begin(), full.end());
  return did_you_mean(name, candidates);
}

/// Reports a glass that a file names and that could not be made: another of the same name is not
/// what was meant.
bool report_lost(Reader& in, std::string_view name, Span at) {
  for (auto const& lost : scene_state(in.interpreter()).lost_glasses) {
    if (name != lost.name && name != lost.maker + "/" + lost.name) continue;
    in.report(Severity::Error, "E0414", lost.reason, at);
    return true;
  }
  return false;
}

/// Parses an entry of the catalogue: `glass_entry "SCHOTT/N-BK7" { ... }`.
GlassPtr read_entry(Reader& in, optics::DataEntry const& entry) {
  GlassPtr glass;
  read_text(in.interpreter(), entry.file.filename().string(), entry.text, [&](Reader& slice) {
    Span const at = slice.next_span();
    if (!slice.accept("glass_entry")) return slice.unexpected("the glass catalogue");
    std::string const full_name = slice.string("name");
    auto const slash = full_name.find('/');
    GlassBuilder builder(slash == std::string::npos ? full_name : full_name.substr(slash + 1));
    if (slash != std::string::npos) builder.maker(full_name.substr(0, slash));
    if (!open_headless(slice)) return slice.unexpected("the glass catalogue");
    glass = read_definition(slice, std::move(builder), at, true);
    slice.close();
  });
  return glass;
}

} // namespace

bool reject_unquoted_glass(Reader& in) {
  if (in.next() != Next::Word && in.next() != Next::Numeric) return false;
  Span at = in.next_span();
  if (!at.valid()) return false;
  std::string_view const text = at.source->text().substr(at.begin);
  std::string_view const name = text.substr(0, text.find_first_of(" \t\r\n{}()<>,;\""));
  auto const* library = glass_library(in, at);
  bool const in_file = find_in_files(scene_state(in.interpreter()), name) != nullptr;
  std::string_view const meant = in_file ? name : library ? library->meant(name) : "";
  if (meant.empty()) return false;
  at.end = at.begin + static_cast<std::uint32_t>(name.size());
  in.report(Severity::Error, "E0413",
            fmt::format("a glass of the catalogue is named in quotes: glass {{ \"{}\" }}", meant),
            at);
  // The name may be several items: what a term of a formula is to the parser.
  while (!in.at_end() && in.next_span().source == at.source && in.next_span().begin < at.end)
    in.skip();
  return true;
}

std::shared_ptr<optics::Glass const> named_glass(Reader& in, std::string const& name, Span at) {
  SceneState& state = scene_state(in.interpreter());
  if (auto glass = find_in_files(state, name)) return glass;
  if (report_lost(in, name, at)) return nullptr;
  if (auto const known = state.named_glasses.find(name); known != state.named_glasses.end())
    return known->second;
  auto const* library = glass_library(in, at);
  if (!library) return nullptr;
  auto entry = library->find(name);
  if (!entry) {
    std::string const nearer =
        library->meant(name).empty() ? nearest_in_files(state, name) : std::string();
    in.report(Severity::Error, entry.error().code,
              nearer.empty() ? entry.error().message
                             : fmt::format("there is no glass '{}'{}", name, nearer),
              at);
    return nullptr;
  }
  GlassPtr glass = read_entry(in, *entry);
  if (glass) state.named_glasses.emplace(name, glass);
  return glass;
}

std::shared_ptr<optics::Glass const> read_glass(Reader& in) {
  if (auto declared = in.accept_value<optics::Glass>()) return read_changes(in, declared);
  if (in.open("glass")) { // what a macro yields
    GlassPtr glass = read_glass(in);
    in.close();
    return read_changes(in, glass);
  }
  if (in.next() == Next::String) {
    Span const at = in.next_span();
    GlassPtr glass = named_glass(in, in.string("name of a glass"), at);
    return read_changes(in, glass ? glass : placeholder());
  }
  Span const span = in.block_span();
  int const line = span.valid() ? span.source->place(span.begin).line : 0;
  return read_definition(in, GlassBuilder(fmt::format("unnamed, line {}", line)), span, false);
}

} // namespace abbe::lang
