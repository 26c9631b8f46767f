#pragma once
// Private to src/io: OpenEXR files made in memory, so that what reaches the disk goes through AtomicFile and
// a full disk is one kind of error for every format.

#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfIO.h>
#include <OpenEXR/ImfPixelType.h>

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "src/core/image.h"

namespace promenade::io {

class ExrMemory : public Imf::OStream {
 public:
  ExrMemory() : Imf::OStream("memory") {}
  void write(const char bytes[], int count) override;
  std::uint64_t tellp() override { return position_; }
  void seekp(std::uint64_t position) override { position_ = position; }
  [[nodiscard]] std::span<const std::byte> bytes() const { return std::as_bytes(std::span(bytes_)); }

 private:
  std::vector<char> bytes_;
  std::uint64_t position_ = 0;
};

/// The channels of one file: pointers into maps that outlive it.
struct ExrChannel {
  std::string name;
  Imf::PixelType type;
  const void* first;   ///< value of the top left pixel
  std::size_t stride;  ///< bytes from pixel to pixel; rows follow without a gap
};

/// Writes a single-part, zip-compressed (16 rows a block) file with these channels. `header` has the window
/// and the attributes.
void writeExr(const std::filesystem::path& file, Imf::Header header, const std::vector<ExrChannel>& channels);

}  // namespace promenade::io
