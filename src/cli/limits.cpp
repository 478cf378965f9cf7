// SPDX-License-Identifier: MIT
#include "cli/limits.hpp"

#include <charconv>
#include <cmath>
#include <fcntl.h>
#include <sys/resource.h>
#include <sys/sysinfo.h>
#include <unistd.h>

#if defined(__SANITIZE_ADDRESS__) // gcc
#define ABBE_WITH_ADDRESS_SANITIZER 1
#elif defined(__has_feature) // clang
#define ABBE_WITH_ADDRESS_SANITIZER __has_feature(address_sanitizer)
#else
#define ABBE_WITH_ADDRESS_SANITIZER 0
#endif

namespace abbe::cli {
namespace {

void limit_memory([[maybe_unused]] rlim_t bytes) {
#if !ABBE_WITH_ADDRESS_SANITIZER // which reserves far more than it uses
  rlimit limit{};
  if (getrlimit(RLIMIT_DATA, &limit) != 0 || limit.rlim_cur <= bytes) return;
  limit.rlim_cur = bytes;
  setrlimit(RLIMIT_DATA, &limit);
#endif
}

} // namespace

void limit_memory_to_machine() {
  struct sysinfo machine {};
  if (sysinfo(&machine) == 0) limit_memory(rlim_t{machine.totalram} / 8 * 7 * machine.mem_unit);
}

std::string limit_memory(std::string const& text) {
  double number = 0;
  auto const [end, failed] = std::from_chars(text.data(), text.data() + text.size(), number);
  std::string_view const unit(end, static_cast<std::size_t>(text.data() + text.size() - end));
  std::size_t const power = std::string_view("KMGT").find(unit.empty() ? ' ' : unit[0]);
  bool const known = unit.empty() || (unit.size() == 1 && power != std::string_view::npos);
  double const bytes =
      unit.empty() ? number : std::ldexp(number, 10 * (1 + static_cast<int>(power)));
  if (failed != std::errc() || !known || !(bytes >= 1) || bytes > 0x1p62)
    return "expected a size such as 512M or 2G, got '" + text + "'";
  limit_memory(static_cast<rlim_t>(bytes));
  return "";
}

void occupy_standard_files() {
  for (int descriptor = 0; descriptor < 3; ++descriptor)
    if (fcntl(descriptor, F_GETFD) < 0) [[maybe_unused]]
      int const opened = open("/dev/null", O_RDONLY); // the lowest that is free
}

} // namespace abbe::cli
