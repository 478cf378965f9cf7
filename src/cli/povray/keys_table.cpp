// SPDX-License-Identifier: MIT
#include "cli/povray/settings.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <fmt/format.h>
#include <memory>

namespace abbe::cli {
namespace {

using Set = std::function<std::string(PovraySettings&, std::string const&)>;

std::string read_number(std::string const& text, double& number) {
  auto const [end, failed] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (failed == std::errc() && end == text.data() + text.size() && std::isfinite(number)) return "";
  return "expected a number, got '" + text + "'";
}

std::string read_switch(std::string const& text, bool& on) {
  for (auto const* word : {"on", "yes", "true", "1"})
    if (same_word(text, word)) return on = true, "";
  for (auto const* word : {"off", "no", "false", "0"})
    if (same_word(text, word)) return on = false, "";
  return "expected on or off, got '" + text + "'";
}

Set on_off(bool PovraySettings::*field) {
  return
      [field](PovraySettings& s, std::string const& text) { return read_switch(text, s.*field); };
}

/// A number in a range; whole ones may have a fraction, which is cut off, as POV-Ray does.
template <class Field>
Set number(Field PovraySettings::*field, double least, double most) {
  return [=](PovraySettings& s, std::string const& text) -> std::string {
    double value = 0;
    if (auto wrong = read_number(text, value); !wrong.empty()) return wrong;
    if (!(value >= least && value <= most))
      return fmt::format("expected a number from {:g} to {:g}, got '{}'", least, most, text);
    if constexpr (std::is_same_v<Field, double> || std::is_same_v<Field, std::optional<double>>)
      s.*field = value;
    else
      s.*field = static_cast<int>(value);
    return "";
  };
}

Set words(std::string PovraySettings::*field) {
  return [field](PovraySettings& s, std::string const& text) -> std::string {
    if (text.empty()) return "expected a name";
    s.*field = text;
    return "";
  };
}

Set appended(std::vector<std::string> PovraySettings::*field) {
  return [field](PovraySettings& s, std::string const& text) -> std::string {
    if (text.empty()) return "expected a text";
    (s.*field).push_back(text);
    return "";
  };
}

/// Changes how POV-Ray works or shows a picture, and nothing in the picture.
Set inert() {
  return [](PovraySettings&, std::string const&) { return std::string(); };
}

/// Is refused when it is put on; `what` ends "... is not supported".
Set not_on(std::string what) {
  return [what](PovraySettings&, std::string const& text) -> std::string {
    bool on = false;
    if (auto wrong = read_switch(text, on); !wrong.empty()) return wrong;
    return on ? what + " is not supported" : "";
  };
}

Set refused(std::string what) {
  return [what](PovraySettings&, std::string const&) { return what + " is not supported"; };
}

/// A program to be run: never done, and said.
Set no_program(std::string_view name) {
  return [name](PovraySettings& s, std::string const&) -> std::string {
    s.remarks.push_back(fmt::format("{}: abbe runs no other programs", name));
    return "";
  };
}

std::string set_type(PovraySettings& s, std::string const& text) {
  char const letter = text.empty() ? '\0' : static_cast<char>(std::toupper(text[0]));
  if (letter == '\0' || std::string_view("BCEHJNPST").find(letter) == std::string_view::npos)
    return "expected a kind of picture: B (BMP), C (TGA, run lengths), E (OpenEXR), H (Radiance "
           "HDR), J (JPEG), N (PNG), P (PPM) or T (TGA), and bits a channel behind it; got '"
           + text + "'";
  s.type = letter == 'S' ? 'N' : letter; // the system's own, on Unix PNG
  if (text.size() == 1) return "";
  return number(&PovraySettings::bits, 1, 16)(s, text.substr(1));
}

std::string set_gamma(PovraySettings& s, std::string const& text) {
  if (same_word(text, "sRGB")) return s.file_gamma = 0, "";
  return number(&PovraySettings::file_gamma, 0.1, 10)(s, text);
}

std::string set_antialias_gamma(PovraySettings&, std::string const& text) {
  double value = 0;
  if (auto wrong = read_number(text, value); !wrong.empty()) return wrong;
  return value == 2.5 ? "" : "a gamma of anti-aliasing other than 2.5 is not supported";
}

std::string set_declaration(PovraySettings& s, std::string const& text) {
  auto const equals = text.find('=');
  if (equals == std::string::npos || equals == 0)
    return "expected Declare=NAME=VALUE, got '" + text + "'";
  s.declarations.push_back(text);
  return "";
}

using S = PovraySettings;

std::vector<PovrayKey> make_keys() {
  constexpr double most_frames = 1e9;
  std::vector<PovrayKey> keys{
      {"All_Console", on_off(&S::messages), true},
      {"All_File", refused("a file of messages"), false},
      {"Antialias", on_off(&S::antialias), true},
      {"Antialias_Depth", number(&S::antialias_depth, 1, 64), false},
      {"Antialias_Gamma", set_antialias_gamma, false},
      {"Antialias_Threshold", number(&S::antialias_threshold, 0, 3), false},
      {"Append_File", inert(), true},
      {"Bits_Per_Color", number(&S::bits, 1, 16), false},
      {"Bits_Per_Colour", number(&S::bits, 1, 16), false},
      {"Bounding", inert(), true},
      {"Bounding_Method", inert(), false},
      {"Bounding_Threshold", inert(), false},
      {"BSP_BaseAccessCost", inert(), false},
      {"BSP_ChildAccessCost", inert(), false},
      {"BSP_ISectCost", inert(), false},
      {"BSP_MaxDepth", inert(), false},
      {"BSP_MissChance", inert(), false},
      {"Buffer_Output", inert(), true},
      {"Buffer_Size", inert(), false},
      {"Clock", number(&S::clock, -1e300, 1e300), false},
      {"Compression", number(&S::compression, -1, 100), false},
      {"Continue_Trace", on_off(&S::continue_trace), true},
      {"Create_Continue_Trace_Log", inert(), true},
      {"Create_Histogram", not_on("a histogram"), true},
      {"Create_Ini", not_on("writing an ini file"), true},
      {"Cyclic_Animation", on_off(&S::cyclic), true},
      {"Debug_Console", on_off(&S::messages), true},
      {"Debug_File", refused("a file of messages"), false},
      {"Declare", set_declaration, false},
      {"Display", inert(), true},
      {"Display_Gamma", inert(), false},
      {"Dither", not_on("dithering"), true},
      {"Dither_Method", inert(), false},
      {"Draw_Vistas", inert(), true},
      {"End_Column", number(&S::end_column, 0, 1e9), false},
      {"End_Row", number(&S::end_row, 0, 1e9), false},
      {"Fatal_Console", inert(), true},
      {"Fatal_File", refused("a file of messages"), false},
      {"Field_Render", not_on("rendering fields"), true},
      {"File_Gamma", set_gamma, false},
      {"Final_Clock", number(&S::final_clock, -1e300, 1e300), false},
      {"Final_Frame", number(&S::final_frame, -most_frames, most_frames), false},
      {"Grayscale_Output", not_on("a picture in greys"), true},
      {"Height", number(&S::height, 1, 100000), false},
      {"High_Reproducibility", inert(), true},
      {"Include_Header", refused("a header that is included first"), false},
      {"Initial_Clock", number(&S::initial_clock, -1e300, 1e300), false},
      {"Initial_Frame", number(&S::initial_frame, -most_frames, most_frames), false},
      {"Input_File_Name", words(&S::input), false},
      {"Jitter", on_off(&S::jitter), true},
      {"Jitter_Amount", number(&S::jitter_amount, 0, 1), false},
      {"Library_Path", appended(&S::library_paths), false},
      {"Light_Buffer", inert(), true},
      {"Max_Image_Buffer_Memory", inert(), false},
      {"Noise_Generator", refused("choosing a noise generator for all"), false},
      {"Odd_Field", not_on("rendering fields"), true},
      {"Output_Alpha", on_off(&S::alpha), true},
      {"Output_File_Name", words(&S::output), false},
      {"Output_File_Type", set_type, false},
      {"Output_to_File", on_off(&S::to_file), true},
      {"Palette", inert(), false},
      {"Pause_When_Done", inert(), true},
      {"Preview_End_Size", inert(), false},
      {"Preview_Start_Size", inert(), false},
      {"Quality", number(&S::quality, 0, 11), false},
      {"Real_Time_Raytracing", not_on("rendering in real time"), true},
      {"Remove_Bounds", inert(), true},
      {"Render_Block_Size", inert(), false},
      {"Render_Console", inert(), true},
      {"Render_File", refused("a file of messages"), false},
      {"Render_Pattern", inert(), false},
      {"Sampling_Method", number(&S::sampling_method, 1, 2), false},
      {"Split_Unions", inert(), true},
      {"Start_Column", number(&S::start_column, 0, 1e9), false},
      {"Start_Row", number(&S::start_row, 0, 1e9), false},
      {"Statistic_Console", inert(), true},
      {"Statistic_File", refused("a file of messages"), false},
      {"Subset_End_Frame", number(&S::subset_end, 0, most_frames), false},
      {"Subset_Start_Frame", number(&S::subset_start, 0, most_frames), false},
      {"Test_Abort", inert(), true},
      {"Test_Abort_Count", inert(), false},
      {"Verbose", on_off(&S::verbose), true},
      {"Version", refused("a version given from outside: write #version in the scene; that"),
       false},
      {"Video_Mode", inert(), false},
      {"Vista_Buffer", inert(), true},
      {"Warning_Console", inert(), true},
      {"Warning_File", refused("a file of messages"), false},
      {"Warning_Level", inert(), false},
      {"Width", number(&S::width, 1, 100000), false},
      {"Work_Threads", number(&S::threads, 1, 1024), false},
  };
  for (std::string_view const when :
       {"Pre_Scene", "Pre_Frame", "Post_Frame", "Post_Scene", "User_Abort", "Fatal_Error"})
    for (std::string_view const what : {"_Command", "_Return"}) {
      static std::vector<std::unique_ptr<std::string>> names; // as long as the keys
      names.push_back(std::make_unique<std::string>(std::string(when) + std::string(what)));
      std::string_view const name = *names.back();
      keys.push_back({name, what == "_Command" ? no_program(name) : inert(), false});
    }
  std::sort(keys.begin(), keys.end(), [](auto const& a, auto const& b) { return a.name < b.name; });
  return keys;
}

} // namespace

std::span<PovrayKey const> povray_keys() {
  static std::vector<PovrayKey> const keys = make_keys();
  return keys;
}

PovrayKey const* find_povray_key(std::string_view name) {
  auto const keys = povray_keys();
  auto const at = std::find_if(keys.begin(), keys.end(),
                               [&](auto const& key) { return same_word(key.name, name); });
  return at == keys.end() ? nullptr : &*at;
}

bool same_word(std::string_view a, std::string_view b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](unsigned char c, unsigned char d) {
    return std::tolower(c) == std::tolower(d);
  });
}

} // namespace abbe::cli
