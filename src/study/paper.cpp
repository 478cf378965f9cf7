// SPDX-License-Identifier: MIT
#include "study/paper.hpp"

#include "image/atomic_file.hpp"
#include "job/child.hpp"

#include <algorithm>
#include <array>
#include <fmt/format.h>

namespace abbe::study {
namespace fs = std::filesystem;
namespace {

struct Figure {
  std::string_view file;  ///< paper/<file>
  std::string_view scene; ///< examples/<scene>
  std::string_view words;
  std::string_view title;
};

constexpr std::array figures{
    Figure{"figure4.png", "prism.scn", "-W 640 -H 480 --bands 16 --aa 3",
           "Figure 4: a prism floats over a grid"},
    Figure{"figure5.png", "prism_detail.scn", "-W 360 -H 226 --bands 8 --dispersion none",
           "Figure 5: part of the prism, no dispersion"},
    Figure{"figure6.png", "prism_detail.scn", "-W 360 -H 226 --bands 8 --dispersion deterministic",
           "Figure 6: deterministic, 8 bands: sharp copies of each line"},
    Figure{"figure7.png", "prism_detail.scn", "-W 360 -H 226 --bands 8 --dispersion stochastic",
           "Figure 7: stochastic, 8 bands, one ray a pixel: noise instead of bands"},
    Figure{"figure7-aa.png", "prism_detail.scn",
           "-W 360 -H 226 --bands 8 --dispersion stochastic --aa 3 --aa-threshold 0",
           "Figure 7, with ten rays a pixel: anti-aliasing leaves the continuous spectrum"},
    Figure{"figure8.png", "paperweight.scn", "-W 480 -H 360 --bands 16",
           "Figure 8: faceted lead crystal"},
    Figure{"figure8-none.png", "paperweight.scn", "-W 480 -H 360 --bands 16 --dispersion none",
           "Figure 8, no dispersion: a block of ice"},
};

/// A row of the paper's table in section 6: seconds on its machine.
struct Row {
  std::string_view mode, label;
  double paper_s;
};
constexpr std::array rows{
    Row{"none", "no dispersion", 70},
    Row{"deterministic", "deterministic", 540},
    Row{"faithful", "stochastic, as published (fan-out 2)", 1133},
    Row{"stochastic", "stochastic, abbe's default (fan-out 1)", 0},
};

std::string_view const table_words = "-W 360 -H 226 --bands 8 --aa off";

struct Timing {
  std::vector<RunRecord> runs;
  double cpu_s() const {
    std::vector<double> seconds;
    for (auto const& run : runs) seconds.push_back(run.cpu_s);
    std::sort(seconds.begin(), seconds.end());
    return seconds[seconds.size() / 2];
  }
  double rays() const { return static_cast<double>(runs.front().rays.total()); }
};

class Paper {
public:
  explicit Paper(PaperOptions const& options) : options_(options) {}

  image::Status write() {
    std::error_code failed;
    fs::create_directories(options_.folder / "paper", failed);
    if (failed)
      return Error{"E0510", fmt::format("cannot write '{}': {}", options_.folder.string(),
                                        failed.message())};
    page_ = head();
    std::pair<std::string_view, std::string> const drawings[] = {
        {"figure1.svg", index_curves(options_.glasses)},
        {"figure2.svg", split_at_interface(*options_.prism)},
        {"figure3.svg", fan_through_prism(*options_.prism)}};
    for (auto const& [name, svg] : drawings)
      if (auto done = image::write_text(options_.folder / "paper" / name, svg); !done) return done;
    page_ += line_drawings();
    for (auto const& figure : figures)
      if (auto done = render(figure); !done) return done;
    if (auto done = measure(); !done) return done;
    page_ += table();
    return image::write_text(options_.folder / "paper.md", page_);
  }

private:
  /// @return the record of `abbe render SCENE words -o picture`
  Result<RunRecord> run(std::string_view scene, std::string_view words, fs::path const& picture) {
    if (options_.on_progress) options_.on_progress(fmt::format("{} {}", scene, words));
    fs::path const stats = fs::path(picture).replace_extension(".stats.json");
    std::vector<std::string> all{"render", (options_.examples / scene).string()};
    for (auto& word : fill_words(words, "")) all.push_back(std::move(word));
    all.insert(all.end(),
               {"-o", picture.string(), "--stats", stats.string(), "--no-checkpoint", "--quiet"});
    auto const child = job::run_child(options_.program, all, 0, options_.stop);
    RunRecord record;
    bool const read = child.end == job::ChildResult::End::Done && read_stats(stats, record);
    std::error_code ignored;
    fs::remove(stats, ignored);
    if (read) return record;
    return Error{"E0531", child.end == job::ChildResult::End::Stopped
                              ? "interrupted"
                              : fmt::format("{} {}: {}", scene, words, child.messages)};
  }

  image::Status render(Figure const& figure) {
    auto const done = run(figure.scene, figure.words, options_.folder / "paper" / figure.file);
    if (!done) return done.error();
    page_ += fmt::format("### {}\n![](paper/{})\n\n`abbe render examples/{} {}`: {:.2f} CPU "
                         "seconds, {} rays.\n\n",
                         figure.title, figure.file, figure.scene, figure.words, done->cpu_s,
                         done->rays.total());
    return std::monostate{};
  }

  /// In turn, so that what else the machine does falls on all alike.
  image::Status measure() {
    fs::path const picture = options_.folder / "paper" / "timing.exr";
    for (int round = 0; round < options_.rounds; ++round)
      for (std::size_t i = 0; i < rows.size(); ++i) {
        auto const done =
            run("prism_detail.scn", fmt::format("{} --dispersion {}", table_words, rows[i].mode),
                picture);
        if (!done) return done.error();
        timings_[i].runs.push_back(*done);
      }
    std::error_code ignored;
    fs::remove(picture, ignored);
    return std::monostate{};
  }

  std::string head() const {
    auto const machine = this_machine();
    return fmt::format(
        "# The paper, reproduced\n\nA. Wilkie, R. F. Tobler, W. Purgathofer, *Raytracing of "
        "Dispersion Effects in Transparent Materials*, WSCG 2000: its figures and its timing "
        "table, from this program. Made by `abbe study --paper -o docs` (abbe {}), on {}, {} "
        "threads, {}, load {:.1f}. Scenes are ours, after the paper's.\n\n",
        options_.version, machine.processor, machine.threads, machine.compiler, machine.load);
  }

  std::string line_drawings() const {
    return fmt::format(
        "### Figure 1: indices of diamond, lead crystal and glasses\n![](paper/figure1.svg)\n\n"
        "`abbe study --paper` (catalogue data, `abbe glass show NAME`); SF6 stands for lead "
        "crystal. Curves end where the data does.\n\n"
        "### Figure 2: one interface\n![](paper/figure2.svg)\n\n`abbe study --paper`: refracted by "
        "the renderer's own operator (`src/optics/refract.hpp`) in {0}. We know of the paper's "
        "figure 2 only that it belongs to this step; the drawing is ours.\n\n"
        "### Figure 3: the fan of a split ray\n![](paper/figure3.svg)\n\n`abbe study --paper`: "
        "rays traced through a prism of 60 degrees of {0}, angles as they are. Left the gaps "
        "that make bands, right how jitter fills them.\n\n",
        options_.prism->full_name());
  }

  std::string table() const {
    auto const& none = timings_[0];
    std::string out = fmt::format(
        "## The timing table of section 6\n`abbe render examples/prism_detail.scn {} --dispersion "
        "MODE`, 8 channels, one ray a pixel; processor seconds, medians of {} runs in turn.\n\n"
        "| mode | paper, s | paper, ratio | abbe, CPU s | abbe, ratio | rays | ratio of rays |\n"
        "|---|---|---|---|---|---|---|\n",
        table_words, options_.rounds);
    for (std::size_t i = 0; i < rows.size(); ++i) {
      auto const& row = rows[i];
      auto const& timing = timings_[i];
      bool const in_paper = row.paper_s > 0;
      out += fmt::format("| {} | {} | {} | {:.3f} | **{:.2f}** | {:.0f} | {:.2f} |\n", row.label,
                         in_paper ? fmt::format("{:.0f}", row.paper_s) : "-",
                         in_paper ? fmt::format("{:.1f}", row.paper_s / rows[0].paper_s) : "-",
                         timing.cpu_s(), timing.cpu_s() / none.cpu_s(), timing.rays(),
                         timing.rays() / none.rays());
    }
    return out + reasons();
  }

  std::string reasons() const {
    auto const rays = [&](std::size_t i) { return timings_[i].rays() / timings_[0].rays(); };
    auto const per_ray = [&](std::size_t i) {
      return timings_[i].cpu_s() / timings_[i].rays() / (timings_[0].cpu_s() / timings_[0].rays());
    };
    return fmt::format(
        "\nWhy the ratios differ:\n"
        "- **Deterministic** ({:.2f} against 7.7): {:.2f} times the rays, near the 8 of one ray a "
        "band (less, for what is reflected before the first split stays one ray), and each ray "
        "costs {:.2f} of a ray of the plain picture: rays of neighbouring wavelengths that met the "
        "same surfaces are traced together (fans), and a monochromatic ray is shaded in one "
        "channel.\n"
        "- **Stochastic, as published** ({:.2f} against 16.2): {:.2f} times the rays. Two bands on "
        "each ray become two rays at the second interface, as in the paper; abbe also sends a "
        "control ray, so that what does not disperse has no noise. Each ray costs {:.2f} of a "
        "plain one.\n"
        "- **Stochastic, default** ({:.2f}): a ray keeps the wavelength that it was given, so it "
        "is never split again: {:.2f} times the rays, and no blur of a band. This is the fan-out 1 "
        "of the paper's future work.\n"
        "- The plain render carries all 8 channels on each ray here as there; the seconds are of "
        "another machine and twenty years apart, only ratios compare.\n",
        timings_[1].cpu_s() / timings_[0].cpu_s(), rays(1), per_ray(1),
        timings_[2].cpu_s() / timings_[0].cpu_s(), rays(2), per_ray(2),
        timings_[3].cpu_s() / timings_[0].cpu_s(), rays(3));
  }

  PaperOptions const& options_;
  std::string page_;
  std::array<Timing, rows.size()> timings_;
};

} // namespace

image::Status write_paper(PaperOptions const& options) {
  return Paper(options).write();
}

} // namespace abbe::study
