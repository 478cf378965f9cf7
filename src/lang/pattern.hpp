// SPDX-License-Identifier: MIT
#pragma once

#include "lang/blocks.hpp"

#include <memory>
#include <utility>

/// Patterns as they stand in pigments, normals and textures.
namespace abbe::lang {

/// A pattern while the block that it stands in is read.
struct PatternDraft {
  std::unique_ptr<texture::PatternInstance> instance; ///< open for changes; null: none yet
  /// Transforms of a block without a pattern: one given to it later has them.
  geometry::Transform moved;
  bool uv = false; ///< the same of uv_mapping

  void load(std::shared_ptr<texture::PatternInstance const> const& from) {
    instance = from ? std::make_unique<texture::PatternInstance>(*from) : nullptr;
  }
  std::shared_ptr<texture::PatternInstance const> store() const {
    return instance ? std::make_shared<texture::PatternInstance const>(*instance) : nullptr;
  }
  /// Takes `uv_mapping`, which acts on the pattern that the block has or is given.
  bool read_uv_mapping(Reader&);
  /// Ends the block that a pattern opened for the items of its list.
  void close(Reader&);
  bool encloses = false; ///< it is open
  bool is_list() const { return instance && instance->pattern->list_size() > 0; }
  void transform(geometry::Transform const&);
};

/// Adds a transform to the way from the surrounding space into the pattern's. Affine steps that
/// follow one another are one.
void append(texture::PatternInstance&, geometry::Transform const&);
/// The same for what others may share.
void transform_pattern(std::shared_ptr<texture::PatternInstance const>&,
                       geometry::Transform const&);
/// Takes the word of a pattern with what belongs to it, when one is next.
bool read_pattern(Reader&, PatternDraft&);
/// The same where a value is wanted: what has none (facets, bump_map) is an error.
bool read_pattern_with_value(Reader&, PatternDraft&);
/// Takes an item of the pattern or a modifier of all patterns, when one is next.
/// @pre there is a pattern
bool read_pattern_modifier(Reader&, PatternDraft&);
/// Is the word next that a pattern begins with?
bool starts_pattern(Reader&);
/// Asks for the word of every pattern, so that "did you mean" offers them. @return false
bool ask_for_patterns(Reader&);

/// Map look-up takes ascending values for granted. POV-Ray finds the first entry above the value,
/// which the running maximum keeps. @param spans of the entries
template <class Entry, class SpanOf>
void make_ascending(std::vector<Entry>& entries, Reader& in, SpanOf const& span_of) {
  bool reported = false;
  for (std::size_t i = 1; i < entries.size(); ++i) {
    if (entries[i].value >= entries[i - 1].value) continue;
    if (!std::exchange(reported, true))
      report_descending(in, entries[i].value, entries[i - 1].value, span_of(entries[i]));
    entries[i].value = entries[i - 1].value;
  }
}
void report_descending(Reader&, double value, double before, Span);

/// The value that a map entry begins with; not a number where there is none, as averages allow.
double read_entry_value(Reader&);
/// Settles the values of a map when its pattern is known: weights of an average, of which those not
/// given are 1, or ascending places.
template <class Entry, class SpanOf>
void settle_values(bool averages, std::vector<Entry>& entries, Reader& in, SpanOf const& span_of) {
  for (Entry& entry : entries)
    if (entry.value != entry.value) {
      if (!averages) report_no_value(in, span_of(entry));
      entry.value = 1;
    }
  if (!averages) make_ascending(entries, in, span_of);
}
void report_no_value(Reader&, Span);

/// The entries of a map, `[value ...]` each.
/// @param read_entry takes the content of the brackets
template <class Entry, class Read>
void read_entries(Reader& in, std::string_view what, std::vector<Entry>& entries,
                  Read const& read_entry) {
  while (!in.at_end()) {
    if (in.open_bracket()) {
      read_entry(in, entries);
      in.close();
    } else {
      reject(in, "an entry [value ...]");
    }
  }
  if (entries.empty())
    in.report(Severity::Error, "E0250", std::string(what) + " has no entries", in.block_span());
}

} // namespace abbe::lang
