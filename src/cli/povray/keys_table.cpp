// SPDX-License-Identifier: MIT
#include "cli/povray/settings.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <fmt/format.h>

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
      {"All_Console", on_off(&S::messages)},
      {"All_File", refused("a file of messages")},
      {"Antialias", on_off(&S::antialias)},
      {"Antialias_Depth", number(&S::antialias_depth, 1, 64)},
      {"Antialias_Gamma", set_antialias_gamma},
      {"Antialias_Threshold", number(&S::antialias_threshold, 0, 3)},
      {"Append_File", inert()},
      {"Bits_Per_Color", number(&S::bits, 1, 16)},
      {"Bits_Per_Colour", number(&S::bits, 1, 16)},
      {"Bounding", inert()},
      {"Bounding_Method", inert()},
      {"Bounding_Threshold", inert()},
      {"BSP_BaseAccessCost", inert()},
      {"BSP_ChildAccessCost", inert()},
      {"BSP_ISectCost", inert()},
      {"BSP_MaxDepth", inert()},
      {"BSP_MissChance", inert()},
      {"Buffer_Output", inert()},
      {"Buffer_Size", inert()},
      {"Clock", number(&S::clock, -1e300, 1e300)},
      {"Compression", number(&S::compression, -1, 100)},
      {"Continue_Trace", on_off(&S::continue_trace)},
      {"Create_Continue_Trace_Log", inert()},
      {"Create_Histogram", not_on("a histogram")},
      {"Create_Ini", not_on("writing an ini file")},
      {"Cyclic_Animation", on_off(&S::cyclic)},
      {"Debug_Console", on_off(&S::messages)},
      {"Debug_File", refused("a file of messages")},
      {"Declare", set_declaration},
      {"Display", inert()},
      {"Display_Gamma", inert()},
      {"Dither", not_on("dithering")},
      {"Dither_Method", inert()},
      {"Draw_Vistas", inert()},
      {"End_Column", number(&S::end_column, 0, 1e9)},
      {"End_Row", number(&S::end_row, 0, 1e9)},
      {"Fatal_Console", inert()},
      {"Fatal_File", refused("a file of messages")},
      {"Field_Render", not_on("rendering fields")},
      {"File_Gamma", set_gamma},
      {"Final_Clock", number(&S::final_clock, -1e300, 1e300)},
      {"Final_Frame", number(&S::final_frame, -most_frames, most_frames)},
      {"Grayscale_Output", not_on("a picture in greys")},
      {"Height", number(&S::height, 1, 100000)},
      {"High_Reproducibility", inert()},
      {"Include_Header", words(&S::header)},
      {"Initial_Clock", number(&S::initial_clock, -1e300, 1e300)},
      {"Initial_Frame", number(&S::initial_frame, -most_frames, most_frames)},
      {"Input_File_Name", words(&S::input)},
      {"Jitter", on_off(&S::jitter)},
      {"Jitter_Amount", number(&S::jitter_amount, 0, 1)},
      {"Library_Path", appended(&S::library_paths)},
      {"Light_Buffer", inert()},
      {"Max_Image_Buffer_Memory", inert()},
      {"Noise_Generator", refused("choosing a noise generator for all")},
      {"Odd_Field", not_on("rendering fields")},
      {"Output_Alpha", on_off(&S::alpha)},
      {"Output_File_Name", words(&S::output)},
      {"Output_File_Type", set_type},
      {"Output_to_File", on_off(&S::to_file)},
      {"Palette", inert()},
      {"Pause_When_Done", inert()},
      {"Preview_End_Size", inert()},
      {"Preview_Start_Size", inert()},
      {"Quality", number(&S::quality, 0, 11)},
      {"Real_Time_Raytracing", not_on("rendering in real time")},
      {"Remove_Bounds", inert()},
      {"Render_Block_Size", inert()},
      {"Render_Console", inert()},
      {"Render_File", refused("a file of messages")},
      {"Render_Pattern", inert()},
      {"Sampling_Method", number(&S::sampling_method, 1, 2)},
      {"Split_Unions", inert()},
      {"Start_Column", number(&S::start_column, 0, 1e9)},
      {"Start_Row", number(&S::start_row, 0, 1e9)},
      {"Statistic_Console", inert()},
      {"Statistic_File", refused("a file of messages")},
      {"Subset_End_Frame", number(&S::subset_end, 0, most_frames)},
      {"Subset_Start_Frame", number(&S::subset_start, 0, most_frames)},
      {"Test_Abort", inert()},
      {"Test_Abort_Count", inert()},
      {"Verbose", on_off(&S::verbose)},
      {"Version", number(&S::version, 0, 3.8)},
      {"Video_Mode", inert()},
      {"Vista_Buffer", inert()},
      {"Warning_Console", inert()},
      {"Warning_File", refused("a file of messages")},
      {"Warning_Level", inert()},
      {"Width", number(&S::width, 1, 100000)},
      {"Work_Threads", number(&S::threads, 1, 1024)},
      {"Fatal_Error_Command", no_program("Fatal_Error_Command")},
      {"Fatal_Error_Return", inert()},
      {"Post_Frame_Command", no_program("Post_Frame_Command")},
      {"Post_Frame_Return", inert()},
      {"Post_Scene_Command", no_program("Post_Scene_Command")},
      {"Post_Scene_Return", inert()},
      {"Pre_Frame_Command", no_program("Pre_Frame_Command")},
      {"Pre_Frame_Return", inert()},
      {"Pre_Scene_Command", no_program("Pre_Scene_Command")},
      {"Pre_Scene_Return", inert()},
      {"User_Abort_Command", no_program("User_Abort_Command")},
      {"User_Abort_Return", inert()},
  };
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
