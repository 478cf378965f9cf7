// SPDX-License-Identifier: MIT
#include "optics/data_library.hpp"
#include "optics/glass_builder.hpp"
#include "optics/scan_pairs.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <charconv>
#include <cmath>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <map>

namespace abbe::optics {
namespace {

DataLibrary const& library() {
  static DataLibrary const result =
      *DataLibrary::open(std::filesystem::path(ABBE_STDLIB_DIR) / "glass");
  return result;
}

/// Just enough to read the files as generate.py writes them; the language has the real parser.
class EntryScanner {
public:
  explicit EntryScanner(std::string_view text) : text_(text) {}

  /// The numbers that follow ` word `, up to something else than blanks, commas and numbers.
  std::vector<double> numbers(std::string_view word) const {
    std::vector<double> result;
    auto at = text_.find(fmt::format(" {} ", word));
    if (at == text_.npos) return result;
    at += word.size() + 2;
    for (;;) {
      while (at < text_.size() && (text_[at] == ' ' || text_[at] == ',' || text_[at] == '{')) ++at;
      double value = 0;
      auto const [end, error] =
          std::from_chars(text_.data() + at, text_.data() + text_.size(), value);
      if (error != std::errc()) return result;
      result.push_back(value);
      at = static_cast<std::size_t>(end - text_.data());
    }
  }
  /// Half a unit of the last decimal of the number that follows ` word `, as printed.
  double half_unit(std::string_view word) const {
    auto const begin = text_.find(fmt::format(" {} ", word)) + word.size() + 2;
    auto const number = text_.substr(begin, text_.find(' ', begin) - begin);
    auto const point = number.find('.');
    std::size_t const decimals = point == number.npos ? 0 : number.size() - point - 1;
    return 0.5 * std::pow(10.0, -static_cast<double>(decimals));
  }
  std::vector<Pair> rows(std::string_view word) const {
    auto const at = text_.find(fmt::format(" {} {{ [", word));
    if (at == text_.npos) return {};
    return *scan_pairs(text_.substr(at));
  }

private:
  std::string_view text_;
};

Result<GlassPtr> build(DataEntry const& entry) {
  EntryScanner const scan(entry.text);
  GlassBuilder builder(entry.name);
  if (auto c = scan.numbers("formula"); !c.empty())
    builder.formula(static_cast<int>(c[0]), std::vector<double>(c.begin() + 1, c.end()));
  if (auto rows = scan.rows("samples"); !rows.empty()) builder.samples(rows);
  if (auto range = scan.numbers("range"); range.size() >= 2) builder.range_um(range[0], range[1]);
  if (auto rows = scan.rows("k"); !rows.empty()) builder.extinction(rows);
  return builder.build();
}

TEST(GlassCatalogue, EveryRowHasItsPrintedNdAndVd) {
  int glasses = 0, formulas = 0, nd_checked = 0, vd_checked = 0;
  std::map<std::string, double> worst_nd, worst_vd;
  for (auto const name : library().names()) {
    auto const entry = library().find(name);
    ASSERT_TRUE(entry.ok()) << name << entry.error().message;
    ASSERT_EQ(entry->name, name);
    ASSERT_EQ(entry->kind, "glass_entry");
    auto const built = build(*entry);
    ASSERT_TRUE(built.ok()) << name << ": " << built.error().message;
    Glass const& glass = **built;
    ++glasses;
    EntryScanner const scan(entry->text);
    bool const fitted = entry->text.find("own_fit_rms") != std::string::npos;
    auto const nd = scan.numbers("nd");
    auto const vd = scan.numbers("Vd");
    bool const formula = std::holds_alternative<GlassFormula>(glass.model());
    formulas += formula;
    auto const file = entry->file.stem().string();
    // The lines may lie just outside a stated range: the printed numbers used the formula all the
    // same.
    if (formula && !nd.empty()) {
      double const own = glass.index_unchecked(587.5618);
      // SUMITA's printed numbers depart from its own coefficients; our fits miss by a few rms
      // (5.6e-5).
      bool const sumita = name.starts_with("SUMITA");
      EXPECT_NEAR(own, nd[0], fitted ? 6e-4 : sumita ? 4e-5 : 1.2 * scan.half_unit("nd")) << name;
      if (!fitted) worst_nd[file] = std::max(worst_nd[file], std::abs(own - nd[0]));
      ++nd_checked;
    }
    if (formula && !vd.empty()) {
      double const spread = glass.index_unchecked(486.1327) - glass.index_unchecked(656.2725);
      double const own = (glass.index_unchecked(587.5618) - 1) / spread;
      double const error = std::abs(own / vd[0] - 1);
      // The printed Vd comes from indices of five or six decimals: nF - nC is good to some 1e-5 in
      // 0.01.
      double const rounding = name.starts_with("SUMITA") ? 3.3e-3 * vd[0] : scan.half_unit("Vd");
      double const tolerance = fitted ? 3e-2 * vd[0] : rounding + 2e-4 * vd[0];
      // The sheet's 65.41 is not that of the published coefficients, 66.04.
      if (name != "SCHOTT/BOROFLOAT33") {
        EXPECT_NEAR(own, vd[0], tolerance) << name;
      }
      if (!fitted) worst_vd[file] = std::max(worst_vd[file], error);
      ++vd_checked;
    }
  }
  EXPECT_EQ(glasses, 1961);
  EXPECT_EQ(formulas, 1721 + 127 + 44);
  for (auto const& [file, error] : worst_nd)
    std::printf("%-14s worst nd error %.2e, worst relative Vd error %.2e\n", file.c_str(), error,
                worst_vd[file]);
  std::printf("%d nd and %d Vd checked\n", nd_checked, vd_checked);
}

TEST(GlassCatalogue, EveryFormulaAgreesWithAnIndependentEvaluation) {
  std::ifstream stream(ABBE_SOURCE_DIR "/tests/data/optics/nd_vd_calc.tsv");
  int rows = 0;
  double worst_nd = 0, worst_vd = 0;
  for (std::string name, nd, vd; std::getline(stream, name);) {
    if (name.empty() || name[0] == '#') continue;
    auto const tab1 = name.find('\t');
    auto const tab2 = name.find('\t', tab1 + 1);
    nd = name.substr(tab1 + 1, tab2 - tab1 - 1);
    vd = name.substr(tab2 + 1);
    auto const glass = *build(*library().find(name.substr(0, tab1)));
    double const spread = glass->index_unchecked(486.1327) - glass->index_unchecked(656.2725);
    worst_nd = std::max(worst_nd, std::abs(glass->index_unchecked(587.5618) - std::stod(nd)));
    worst_vd = std::max(worst_vd,
                        std::abs((glass->index_unchecked(587.5618) - 1) / spread - std::stod(vd)));
    ++rows;
  }
  EXPECT_GT(rows, 1650);
  EXPECT_LT(worst_nd, 1e-7); // seven decimals were written
  EXPECT_LT(worst_vd, 1e-4); // four
  std::printf("%d rows: worst nd %.1e, worst Vd %.1e\n", rows, worst_nd, worst_vd);
}

TEST(GlassCatalogue, EveryFormulaIsSmoothOverTheVisible) {
  int checked = 0;
  for (auto const name : library().names()) {
    auto const entry = *library().find(name);
    auto const glass = *build(entry);
    auto const* formula = std::get_if<GlassFormula>(&glass->model());
    if (!formula || glass->range_nm().lo_nm > 500) continue; // infrared glasses
    // A quarter of the catalogue states a range that ends within the visible: its formulas go on
    // smoothly.
    bool const maker = entry.name.find('/') != std::string::npos && entry.file.stem() != "crystals";
    double const lo = maker ? 380.0 : std::max(380.0, glass->range_nm().lo_nm);
    double const hi = maker ? 780.0 : std::min(780.0, glass->range_nm().hi_nm);
    double last = glass->index_unchecked(lo);
    for (double l = lo + 5; l <= hi; l += 5) {
      double const n = glass->index_unchecked(l);
      ASSERT_TRUE(n >= 1 && n < last) << name << ' ' << l;
      last = n;
    }
    ++checked;
  }
  EXPECT_GT(checked, 1800);
}

TEST(GlassCatalogue, IndexFitsTheFiles) {
  for (char const* folder : {"glass", "spectra"}) {
    std::filesystem::path const dir = std::filesystem::path(ABBE_STDLIB_DIR) / folder;
    std::map<std::string, std::string> texts;
    std::ifstream index(dir / "index.txt");
    std::size_t entries = 0;
    std::map<std::string, std::size_t> lines;
    for (std::string name, file, offset, length; std::getline(index, name, '\t');) {
      std::getline(index, file, '\t');
      std::getline(index, offset, '\t');
      std::getline(index, length);
      auto& text = texts[file];
      if (text.empty()) {
        std::ifstream stream(dir / file, std::ios::binary);
        text.assign(std::istreambuf_iterator<char>(stream), {});
        for (std::size_t at = 0; (at = text.find("_entry \"", at)) != text.npos; ++at)
          ++lines[file];
      }
      std::string const slice = text.substr(std::stoul(offset), std::stoul(length));
      ASSERT_TRUE(slice.find("_entry \"") < 20 && slice.back() == '}') << name;
      ASSERT_EQ(text[std::stoul(offset) + std::stoul(length)], '\n');
      entries += slice.find("_entry \"" + name + "\" {") < 20; // else an alias
    }
    std::size_t in_files = 0;
    for (auto const& [file, count] : lines) in_files += count;
    EXPECT_EQ(entries, in_files) << folder;
  }
}

TEST(GlassCatalogue, ShortNamesAreTakenWhereUnique) {
  EXPECT_EQ(library().find("N-BK7")->name, "SCHOTT/N-BK7");
  EXPECT_EQ(library().find("diamond")->name, "diamond");
  EXPECT_EQ(library().find("sapphire/o")->name, "sapphire/o");
  auto const f2 = library().find("F2");
  EXPECT_EQ(f2.error().code, "E0413");
  EXPECT_EQ(f2.error().message,
            "'F2' is ambiguous: say one of 'CDGM/F2', 'HIKARI/F2', 'SCHOTT/F2'");
  EXPECT_EQ(library().find("sapphire").error().message,
            "'sapphire' is ambiguous: say one of 'sapphire/e', 'sapphire/o'");
  EXPECT_NE(library().find("N-BK8").error().message.find("did you mean"), std::string::npos);
  EXPECT_FALSE(library().find("").ok());
  EXPECT_EQ(library().list("SCHOTT").size(), 171u);
  EXPECT_GE(library().makers().size(), 13u);
}

TEST(GlassCatalogue, FindsAnEntryQuickly) {
  auto const start = std::clock();
  auto const opened = *DataLibrary::open(std::filesystem::path(ABBE_STDLIB_DIR) / "glass");
  auto const middle = std::clock();
  for (int i = 0; i < 100; ++i) ASSERT_TRUE(opened.find("N-SF11").ok());
  auto const end = std::clock();
  double const to_us = 1e6 / CLOCKS_PER_SEC;
  double const open = to_us * static_cast<double>(middle - start),
               find = to_us * static_cast<double>(end - middle) / 100;
  std::printf("open %.0f us, find %.1f us\n", open, find);
  EXPECT_LT(find, 2000); // 50 us of processor time in a release build; sanitizers take tenfold
}

TEST(DataLibrary, NamesOfOtherCaseAndSignsAreMeant) {
  for (char const* written : {"n-bk7", "NBK7", "N_BK7", "BK7", "bk 7"})
    EXPECT_EQ(library().meant(written), "N-BK7") << written;
  EXPECT_EQ(library().meant("schott/n-sf11"), "SCHOTT/N-SF11");
  EXPECT_EQ(library().meant("Diamond"), "diamond");
  EXPECT_EQ(library().meant("N-BK8"), "");
  EXPECT_EQ(library().meant("-"), "");
  EXPECT_NE(library().find("n-bk7").error().message.find("did you mean 'N-BK7'?"),
            std::string::npos);
}

TEST(DataLibrary, DamageIsReported) {
  auto const dir = std::filesystem::temp_directory_path()
                   / fmt::format("abbe_library_{}", static_cast<void const*>(&library()));
  std::filesystem::create_directories(dir);
  EXPECT_EQ(DataLibrary::open(dir).error().code, "E0501");
  auto const write = [&](char const* file, std::string const& text) {
    std::ofstream(dir / file, std::ios::binary) << text;
  };
  for (char const* text : {"x", "a\tb\n", "a\tb\tc\td\n", "a\tb\t1\t\n", "b\tf\t0\t1\na\tf\t0\t1\n",
                           "a\tf\t0\t99999999999\n"}) {
    write("index.txt", text);
    EXPECT_EQ(DataLibrary::open(dir).error().code, "E0417") << text;
  }
  write("index.txt", "a\tf.inc\t0\t20\nb\tmissing.inc\t0\t20\n");
  write("f.inc", "glass_entry \"a\" { constant 1.5 }\n");
  EXPECT_EQ(DataLibrary::open(dir)->find("a").error().code, "E0417"); // cut short
  EXPECT_EQ(DataLibrary::open(dir)->find("b").error().code, "E0501");
  std::filesystem::remove_all(dir);
}

} // namespace
} // namespace abbe::optics
