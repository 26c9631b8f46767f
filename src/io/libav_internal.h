#pragma once
// Private to src/io: owners for the handles of the FFmpeg libraries and their errors.

extern "C" {
#include <libavcodec/avcodec.h>
#include <libavformat/avformat.h>
#include <libswscale/swscale.h>
}

#include <atomic>
#include <memory>
#include <new>
#include <string>

namespace promenade::io {

struct LibavDelete {
  void operator()(AVCodecContext* codec) const { avcodec_free_context(&codec); }
  void operator()(AVFrame* frame) const { av_frame_free(&frame); }
  void operator()(AVPacket* packet) const { av_packet_free(&packet); }
  void operator()(SwsContext* scaler) const { sws_freeContext(scaler); }
};
using CodecContext = std::unique_ptr<AVCodecContext, LibavDelete>;
using VideoFrame = std::unique_ptr<AVFrame, LibavDelete>;
using Packet = std::unique_ptr<AVPacket, LibavDelete>;
using Scaler = std::unique_ptr<SwsContext, LibavDelete>;

/// Errors that a decoder has reported while it went on. AVCodecContext::opaque points to one of these.
using ErrorCount = std::atomic<int>;

/// The libraries print to stderr unless told not to; where their log goes belongs to the process, and this is
/// the only place that sets it. Nothing is printed: errors reach the user through our messages. Decoders
/// conceal some damage (a wrong checksum in FFV1) and say so in the log alone; those errors are added to the
/// decoder's ErrorCount. To be called before any other use of the libraries.
void redirectLibavLog();

/// "Invalid data found when processing input"
[[nodiscard]] std::string libavMessage(int error);

/// Allocation functions return null for one reason only.
template <class Handle>
Handle allocated(typename Handle::pointer pointer) {
  if (pointer == nullptr) throw std::bad_alloc();
  return Handle(pointer);
}

}  // namespace promenade::io
