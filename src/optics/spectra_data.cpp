// SPDX-License-Identifier: MIT
#include "optics/spectra_data.hpp"

#include "optics/scan_pairs.hpp"

#include <fmt/format.h>

namespace abbe::optics {
namespace {

Error wrong_kind(DataEntry const& entry, std::string_view wanted) {
  return Error{"E0413", fmt::format("'{}' is a {}, not a {}", entry.name,
                                    entry.kind.substr(0, entry.kind.size() - 6), wanted)};
}

} // namespace

Result<Spectrum> load_light(DataLibrary const& library, std::string_view name) {
  auto entry = library.find(name);
  if (!entry) return entry.error();
  if (entry->kind != "illuminant_entry" && entry->kind != "lamp_entry")
    return wrong_kind(*entry, "light");
  auto rows = scan_pairs(entry->text);
  if (!rows) return rows.error();
  return Spectrum::power(std::move(*rows));
}

Result<Spectrum> load_reflectance(DataLibrary const& library, std::string_view name) {
  auto entry = library.find(name);
  if (!entry) return entry.error();
  if (entry->kind != "reflectance_entry") return wrong_kind(*entry, "reflectance");
  auto rows = scan_pairs(entry->text);
  if (!rows) return rows.error();
  return Spectrum::samples(std::move(*rows));
}

Result<Conductor> load_metal(DataLibrary const& library, std::string_view name) {
  auto entry = library.find(name);
  if (!entry) return entry.error();
  if (entry->kind != "metal_entry") return wrong_kind(*entry, "metal");
  auto rows = scan_rows<3>(entry->text);
  if (!rows) return rows.error();
  return Conductor::make(entry->name, std::move(*rows));
}

} // namespace abbe::optics
