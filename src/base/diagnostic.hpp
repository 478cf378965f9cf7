// SPDX-License-Identifier: MIT
#pragma once

#include "base/source.hpp"

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace abbe {

enum class Severity { Error, Warning, Note };

/// One message for a person: what is wrong, where, what was expected.
/// Codes: E01xx lexing and syntax, E02xx names and items, E03xx values and expressions,
/// E04xx optics and materials, E05xx files, E06xx geometry, E07xx limits, E09xx not supported yet.
struct Diagnostic {
  std::string code; ///< "E0203"; empty for user messages (#debug, #warning, #error)
  Severity severity = Severity::Error;
  Span span; ///< may be invalid: a message about no place in a source
  std::string message;
  struct Note {
    Span span;
    std::string message;
  };
  std::vector<Note> notes; ///< "called from", "included from", "declared here"
};

/// `a.scn:3:9-13: error[E0203]: message`, the source line, carets, then the notes.
std::string format(Diagnostic const& diagnostic);

/// The name out of `valid` closest to `name` by edit distance, empty when none is near
/// (at most a third of the letters differ).
std::string_view nearest_name(std::string_view name, std::span<std::string_view const> valid);

/// "; did you mean 'sphere'?" or "".
std::string did_you_mean(std::string_view name, std::span<std::string_view const> valid);

} // namespace abbe
