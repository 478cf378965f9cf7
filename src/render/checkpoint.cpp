// SPDX-License-Identifier: MIT
#include "render/checkpoint.hpp"

#include "base/new_file.hpp"
#include "base/word_hash.hpp"

#include <array>
#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <system_error>
#include <unistd.h>

namespace abbe::render {
namespace {

struct Header {
  std::array<char, 16> magic{'a', 'b', 'b', 'e', ' ', 'c', 'h', 'e',
                             'c', 'k', 'p', 'o', 'i', 'n', 't', '2'};
  std::uint64_t hash = 0;
  std::uint32_t tiles = 0, passes = 0;
  std::uint64_t checksum = 0; ///< of the above
};
static_assert(sizeof(Header) == 40);

std::uint64_t checksum(Header header) {
  header.checksum = 0;
  WordHash sum;
  sum.add(&header, sizeof header);
  return sum.value();
}

struct Record {
  std::uint32_t pass = 0, tile = 0;
  std::uint64_t count = 0; ///< of floats behind it
  RayCounts counts;
  CutLight cut;
  std::uint64_t checksum = 0; ///< of the floats and of the above
};
static_assert(std::is_trivially_copyable_v<Record>);

/// Torn writes are what it must find.
std::uint64_t checksum(Record record, std::span<float const> values) {
  record.checksum = 0;
  WordHash sum;
  sum.add(&record, sizeof record);
  sum.add(values.data(), values.size_bytes());
  return sum.value();
}

std::string reason() {
  return std::generic_category().message(errno);
}

bool read_at(int descriptor, void* out, std::size_t count, std::uint64_t offset) {
  auto* at = static_cast<char*>(out);
  while (count > 0) {
    ssize_t const got = ::pread(descriptor, at, count, static_cast<off_t>(offset));
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0) return false;
    at += got;
    count -= static_cast<std::size_t>(got);
    offset += static_cast<std::uint64_t>(got);
  }
  return true;
}

} // namespace

Checkpoint::Checkpoint(std::filesystem::path path, double delay_seconds,
                       std::function<std::uint64_t()> identity)
    : path_(std::move(path)),
      from_(std::chrono::steady_clock::now()
            + std::chrono::duration_cast<std::chrono::steady_clock::duration>(
                std::chrono::duration<double>(delay_seconds))),
      identity_(std::move(identity)) {}

Checkpoint::~Checkpoint() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

Result<std::size_t> Checkpoint::resume() {
  auto const refuse = [this](std::string const& why) {
    return Error{"E0521", fmt::format("cannot go on from '{}': {}", path_.string(), why)};
  };
  int const descriptor = ::open(path_.c_str(), O_RDWR | O_CLOEXEC);
  if (descriptor < 0 && errno == ENOENT) return std::size_t{0};
  if (descriptor < 0) return refuse(reason());
  descriptor_ = descriptor;
  if (::flock(descriptor_, LOCK_EX | LOCK_NB) != 0) return refuse("another render is writing it");
  Header header;
  auto const magic = header.magic;
  if (!read_at(descriptor_, &header, sizeof header, 0) || header.magic != magic)
    return refuse("it is not a checkpoint of this version of abbe");
  if (header.checksum != checksum(header)) return refuse("its beginning is damaged");
  if (header.hash != identity_())
    return Error{"E0520",
                 fmt::format("'{}' belongs to another scene, other options or another build of "
                             "abbe: render with those, or without --resume to begin again",
                             path_.string())};
  tiles_ = header.tiles;
  passes_ = header.passes;
  return read_tiles();
}

/// Finds the whole tiles; what comes behind the last is cut off when the next is written.
Result<std::size_t> Checkpoint::read_tiles() {
  offsets_.clear();
  end_ = sizeof(Header);
  std::vector<float> values;
  struct stat status {};
  if (::fstat(descriptor_, &status) != 0) return Error{"E0521", reason()};
  auto const size = static_cast<std::uint64_t>(status.st_size);
  Record record;
  while (end_ + sizeof record <= size && read_at(descriptor_, &record, sizeof record, end_)) {
    std::uint64_t const next = end_ + sizeof record + record.count * sizeof(float);
    if (record.count > size || next > size || record.pass >= passes_ || record.tile >= tiles_)
      break;
    values.resize(record.count);
    if (!read_at(descriptor_, values.data(), values.size() * sizeof(float), end_ + sizeof record)
        || checksum(record, values) != record.checksum)
      break;
    offsets_[slot(record.pass, record.tile)] = end_;
    end_ = next;
  }
  return offsets_.size();
}

void Checkpoint::begin(std::uint32_t tiles, std::uint32_t passes) {
  if (descriptor_ >= 0) {
    // The identity covers them: only a forged file has others.
    if (tiles != tiles_ || passes != passes_) {
      offsets_.clear();
      problem_ = "the checkpoint is of another picture";
    } else if (::ftruncate(descriptor_, static_cast<off_t>(end_)) != 0) {
      problem_ = reason();
    }
    return;
  }
  tiles_ = tiles;
  passes_ = passes;
}

std::optional<TileResult> Checkpoint::find(std::uint32_t pass, std::uint32_t tile) const {
  auto const known = offsets_.find(slot(pass, tile));
  if (known == offsets_.end()) return std::nullopt;
  std::uint64_t const offset = known->second;
  Record record;
  TileResult result;
  if (!read_at(descriptor_, &record, sizeof record, offset)) return std::nullopt;
  result.values.resize(record.count);
  if (!read_at(descriptor_, result.values.data(), record.count * sizeof(float),
               offset + sizeof record)
      || checksum(record, result.values) != record.checksum)
    return std::nullopt;
  result.counts = record.counts;
  result.cut = record.cut;
  return result;
}

void Checkpoint::keep(std::uint32_t pass, std::uint32_t tile, TileResult const& result) {
  if (std::chrono::steady_clock::now() < from_) return;
  Record record;
  record.pass = pass;
  record.tile = tile;
  record.count = result.values.size();
  record.counts = result.counts;
  record.cut = result.cut;
  record.checksum = checksum(record, result.values);
  std::vector<char> bytes(sizeof record + result.values.size() * sizeof(float));
  std::memcpy(bytes.data(), &record, sizeof record);
  std::memcpy(bytes.data() + sizeof record, result.values.data(),
              result.values.size() * sizeof(float));
  std::lock_guard const lock(appending_);
  if (!problem_.empty() || (descriptor_ < 0 && !start_file())) return;
  if (append(bytes.data(), bytes.size())) return;
  problem_ = reason();
}

bool Checkpoint::start_file() {
  // Not under its name before it has a header: a file that is there can be gone on from.
  auto const file = make_file_beside(path_);
  descriptor_ = file.descriptor;
  Header header;
  header.hash = identity_();
  header.tiles = tiles_;
  header.passes = passes_;
  header.checksum = checksum(header);
  bool const made = descriptor_ >= 0 && ::flock(descriptor_, LOCK_EX | LOCK_NB) == 0
                    && append(&header, sizeof header)
                    && ::rename(file.path.c_str(), path_.c_str()) == 0;
  if (made) return true;
  problem_ = reason();
  if (descriptor_ >= 0) ::close(descriptor_);
  descriptor_ = -1;
  ::unlink(file.path.c_str());
  return false;
}

bool Checkpoint::append(void const* bytes, std::size_t count) {
  auto const* at = static_cast<char const*>(bytes);
  std::uint64_t offset = end_;
  for (std::size_t left = count; left > 0;) {
    ssize_t const put = ::pwrite(descriptor_, at, left, static_cast<off_t>(offset));
    if (put < 0 && errno == EINTR) continue;
    if (put <= 0) return false;
    at += put;
    left -= static_cast<std::size_t>(put);
    offset += static_cast<std::uint64_t>(put);
  }
  end_ = offset;
  return true;
}

void Checkpoint::remove() {
  if (descriptor_ < 0) return;
  ::unlink(path_.c_str());
  ::close(descriptor_);
  descriptor_ = -1;
}

} // namespace abbe::render
