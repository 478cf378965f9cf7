// SPDX-License-Identifier: MIT
#include "base/file_text.hpp"

#include <cstdint>
#include <fcntl.h>
#include <filesystem>
#include <fstream>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

namespace abbe {
namespace {

namespace fs = std::filesystem;

/// A file of so many bytes is mapped.
constexpr std::size_t large = std::size_t{1} << 20;

std::optional<std::string> read_stream(std::string const& path) {
  std::error_code failed;
  std::ifstream in(path, std::ios::binary);
  std::string text;
  // Of the size that it has, in one piece; on if it has grown, or told none (/proc).
  std::uintmax_t const told = fs::file_size(path, failed);
  std::size_t more = failed ? 0 : static_cast<std::size_t>(told);
  for (std::size_t size = 0; in; more = 4096) {
    text.resize(size + more);
    in.read(text.data() + size, static_cast<std::streamsize>(more));
    size += static_cast<std::size_t>(in.gcount());
    text.resize(size);
    if (in.peek() == std::ifstream::traits_type::eof()) break;
  }
  if (!in.eof() || in.bad()) return std::nullopt;
  return text;
}

} // namespace

struct FileText::Mapping {
  int file;
  struct stat status; ///< when it was mapped
  void* bytes;
  std::size_t size() const { return static_cast<std::size_t>(status.st_size); }
};

void FileText::Unmap::operator()(Mapping* mapping) const {
  munmap(mapping->bytes, mapping->size());
  close(mapping->file);
  delete mapping;
}

std::unique_ptr<FileText::Mapping, FileText::Unmap> FileText::map(std::string const& path) {
  int const file = open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (file < 0) return nullptr;
  struct stat status {};
  if (fstat(file, &status) == 0 && S_ISREG(status.st_mode)) {
    auto const size = static_cast<std::size_t>(status.st_size);
    void* const bytes = mmap(nullptr, size, PROT_READ, MAP_PRIVATE, file, 0);
    if (bytes != MAP_FAILED) {
      madvise(bytes, size, MADV_SEQUENTIAL);
      return {new Mapping{file, status, bytes}, Unmap{}};
    }
  }
  close(file);
  return nullptr;
}

std::optional<FileText> FileText::read(std::string const& path) {
  std::error_code failed;
  if (!fs::is_regular_file(path, failed)) return std::nullopt;
  if (fs::file_size(path, failed) >= large && !failed) {
    FileText text;
    text.mapping_ = map(path);
    if (text.mapping_) return text;
  }
  return read_stream(path);
}

std::string_view FileText::view() const {
  if (!mapping_) return own_;
  return {static_cast<char const*>(mapping_->bytes), mapping_->size()};
}

std::string FileText::take() && {
  return mapping_ ? std::string(view()) : std::move(own_);
}

void FileText::give_up(std::size_t begin, std::size_t end) const {
  if (!mapping_) return;
  auto const page = static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
  begin = (begin + page - 1) / page * page;
  end = end / page * page;
  if (begin < end) madvise(static_cast<char*>(mapping_->bytes) + begin, end - begin, MADV_DONTNEED);
}

bool FileText::changed() const {
  if (!mapping_) return false;
  struct stat now {};
  return fstat(mapping_->file, &now) != 0 || now.st_size != mapping_->status.st_size
         || now.st_mtim.tv_sec != mapping_->status.st_mtim.tv_sec
         || now.st_mtim.tv_nsec != mapping_->status.st_mtim.tv_nsec;
}

} // namespace abbe
