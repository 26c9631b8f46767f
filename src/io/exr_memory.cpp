#include "src/io/exr_memory_internal.h"

#include <OpenEXR/Iex.h>
#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfOutputFile.h>

#include <cstring>

#include "src/core/errors.h"
#include "src/io/atomic_file.h"

namespace promenade::io {

void ExrMemory::write(const char bytes[], int count) {
  const std::size_t end = position_ + static_cast<std::size_t>(count);
  if (end > bytes_.size()) bytes_.resize(end);
  std::memcpy(bytes_.data() + position_, bytes, static_cast<std::size_t>(count));
  position_ = end;
}

void writeExr(const std::filesystem::path& file, Imf::Header header,
              const std::vector<ExrChannel>& channels) {
  header.compression() = Imf::ZIP_COMPRESSION;
  const auto width = static_cast<std::size_t>(header.dataWindow().max.x + 1);
  Imf::FrameBuffer buffer;
  for (const ExrChannel& channel : channels) {
    header.channels().insert(channel.name, Imf::Channel(channel.type));
    // OpenEXR has one slice type for reading and writing; writing leaves the pixels alone.
    char* base = static_cast<char*>(const_cast<void*>(channel.first));
    buffer.insert(channel.name, Imf::Slice(channel.type, base, channel.stride, channel.stride * width));
  }
  ExrMemory memory;
  try {
    Imf::OutputFile out(memory, header, 0);
    out.setFrameBuffer(buffer);
    out.writePixels(header.dataWindow().max.y + 1);
  } catch (const Iex::BaseExc& error) {
    throw CannotContinue(file.string() + ": cannot encode OpenEXR: " + error.what());
  }
  writeFileAtomically(file, memory.bytes());
}

}  // namespace promenade::io
