// SPDX-License-Identifier: MIT
#include "cli/povray/settings.hpp"

#include <array>

namespace abbe::cli {
namespace {

constexpr std::array switches{
    PovraySwitch{"A", "Antialias", "Antialias_Threshold"},
    PovraySwitch{"AG", "", "Antialias_Gamma"},
    PovraySwitch{"AM", "", "Sampling_Method"},
    PovraySwitch{"B", "Buffer_Output", "Buffer_Size"},
    PovraySwitch{"BM", "", "Bounding_Method"},
    PovraySwitch{"BP", "", "Render_Pattern"},
    PovraySwitch{"BS", "", "Render_Block_Size"},
    PovraySwitch{"C", "Continue_Trace", ""},
    PovraySwitch{"D", "Display", "Palette"},
    PovraySwitch{"EC", "", "End_Column"},
    PovraySwitch{"EF", "", "Subset_End_Frame"},
    PovraySwitch{"EP", "", "Preview_End_Size"},
    PovraySwitch{"ER", "", "End_Row"},
    PovraySwitch{"F", "Output_to_File", "Output_File_Type"},
    PovraySwitch{"FG", "Grayscale_Output", ""},
    PovraySwitch{"GA", "All_Console", "All_File"},
    PovraySwitch{"GD", "Debug_Console", "Debug_File"},
    PovraySwitch{"GF", "Fatal_Console", "Fatal_File"},
    PovraySwitch{"GI", "Create_Ini", ""},
    PovraySwitch{"GR", "Render_Console", "Render_File"},
    PovraySwitch{"GS", "Statistic_Console", "Statistic_File"},
    PovraySwitch{"GW", "Warning_Console", "Warning_File"},
    PovraySwitch{"H", "", "Height"},
    PovraySwitch{"HI", "", "Include_Header"},
    PovraySwitch{"HR", "High_Reproducibility", ""},
    PovraySwitch{"I", "", "Input_File_Name"},
    PovraySwitch{"J", "Jitter", "Jitter_Amount"},
    PovraySwitch{"K", "", "Clock"},
    PovraySwitch{"KC", "Cyclic_Animation", ""},
    PovraySwitch{"KF", "", "Final_Clock"},
    PovraySwitch{"KFF", "", "Final_Frame"},
    PovraySwitch{"KFI", "", "Initial_Frame"},
    PovraySwitch{"KI", "", "Initial_Clock"},
    PovraySwitch{"L", "", "Library_Path"},
    PovraySwitch{"MB", "Bounding", "Bounding_Threshold"},
    PovraySwitch{"MI", "", "Max_Image_Buffer_Memory"},
    PovraySwitch{"MV", "", "Version"},
    PovraySwitch{"NR", "", "Noise_Generator"},
    PovraySwitch{"O", "", "Output_File_Name"},
    PovraySwitch{"P", "Pause_When_Done", ""},
    PovraySwitch{"Q", "", "Quality"},
    PovraySwitch{"R", "", "Antialias_Depth"},
    PovraySwitch{"RP", "", "Real_Time_Raytracing"},
    PovraySwitch{"SC", "", "Start_Column"},
    PovraySwitch{"SF", "", "Subset_Start_Frame"},
    PovraySwitch{"SP", "", "Preview_Start_Size"},
    PovraySwitch{"SR", "", "Start_Row"},
    PovraySwitch{"SU", "Split_Unions", ""},
    PovraySwitch{"TH", "Dither", "Dither_Method"},
    PovraySwitch{"UA", "Output_Alpha", ""},
    PovraySwitch{"UD", "Draw_Vistas", ""},
    PovraySwitch{"UF", "Field_Render", ""},
    PovraySwitch{"UL", "Light_Buffer", ""},
    PovraySwitch{"UO", "Odd_Field", ""},
    PovraySwitch{"UR", "Remove_Bounds", ""},
    PovraySwitch{"UV", "Vista_Buffer", ""},
    PovraySwitch{"V", "Verbose", ""},
    PovraySwitch{"WL", "", "Warning_Level"},
    PovraySwitch{"WT", "", "Work_Threads"},
    PovraySwitch{"W", "", "Width"},
    PovraySwitch{"X", "Test_Abort", "Test_Abort_Count"},
};

} // namespace

std::span<PovraySwitch const> povray_switches() {
  return switches;
}

} // namespace abbe::cli
