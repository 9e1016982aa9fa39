// The only file, with libav.cpp, that knows libav.
#include "scripting/program/video.h"

#include <algorithm>
#include <array>
#include <fstream>
#include <new>
#include <string>
#include <system_error>
#include <vector>

#include "engine/base/error.h"
#include "engine/base/output_file.h"
#include "scripting/program/libav.h"

namespace stampede::program {
namespace {

namespace fs = std::filesystem;

// libav's owners: a pointer to the pointer is what frees it.
template <typename Type, auto Free>
struct Freer {
  void operator()(Type* pointer) const { (av().*Free)(&pointer); }
};
using Frame = std::unique_ptr<AVFrame, Freer<AVFrame, &LibAv::av_frame_free>>;
using Packet = std::unique_ptr<AVPacket, Freer<AVPacket, &LibAv::av_packet_free>>;
using Coder = std::unique_ptr<AVCodecContext, Freer<AVCodecContext, &LibAv::avcodec_free_context>>;
struct FreeFormat {
  void operator()(AVFormatContext* format) const {
    if (format->pb != nullptr) av().avio_closep(&format->pb);
    av().avformat_free_context(format);
  }
};
using Format = std::unique_ptr<AVFormatContext, FreeFormat>;
struct FreeScaler {
  void operator()(SwsContext* scaler) const { av().sws_freeContext(scaler); }
};

// A box of the kind that players skip, after all others: by it a film is known to be ours.
const std::string& film_mark() {
  static const std::string mark = std::string("\0\0\0\x19", 4) + "freedrawn by stampede";
  return mark;
}

int even(int size) { return size + size % 2; }

Frame new_frame(int width, int height, AVPixelFormat pixels) {
  Frame frame(av().av_frame_alloc());
  if (!frame) throw std::bad_alloc();
  frame->width = width;
  frame->height = height;
  frame->format = pixels;
  if (av().av_frame_get_buffer(frame.get(), 0) < 0) throw std::bad_alloc();
  return frame;
}

// A picture as libav's frame; sides that the frame has more repeat the last pixels.
void copy_pixels(std::span<const std::uint8_t> rgb, int width, int height, AVFrame& frame) {
  for (int y = 0; y < frame.height; ++y) {
    const std::uint8_t* from = rgb.data() + static_cast<std::ptrdiff_t>(std::min(y, height - 1)) * width * 3;
    std::uint8_t* to = frame.data[0] + static_cast<std::ptrdiff_t>(y) * frame.linesize[0];
    std::copy(from, from + static_cast<std::ptrdiff_t>(width) * 3, to);
    for (int x = width; x < frame.width; ++x) std::copy(from + (width - 1) * 3, from + width * 3, to + x * 3);
  }
}

}  // namespace

struct VideoWriter::Impl {
  fs::path file;
  std::unique_ptr<OutputFile> output;
  std::string part;  // where libav writes
  int width = 0, height = 0, rate = 0;
  std::int64_t pictures = 0;
  bool finished = false;
  Format format;
  Coder coder;
  Packet packet{av().av_packet_alloc()};
  AVStream* stream = nullptr;
  std::unique_ptr<SwsContext, FreeScaler> scaler;

  ~Impl() {
    if (finished) return;
    format.reset();  // ahead of what it writes to
  }

  [[noreturn]] void failed(const std::string& what, int code) const {
    std::array<char, AV_ERROR_MAX_STRING_SIZE> text{};
    av().av_strerror(code, text.data(), text.size());
    const bool full = code == AVERROR(ENOSPC) || code == AVERROR(EFBIG);
    throw Error(file.string(), what + ": " + text.data(), full ? "free some space, or write to another disk" : "");
  }
  void must(int code, const char* what) const {
    if (code < 0) failed(what, code);
  }

  void start();
  void encode(AVFrame* frame);
  void add(std::span<const std::uint8_t> rgb);
  void close_file();
};

void VideoWriter::Impl::start() {
  AVFormatContext* made = nullptr;
  must(av().avformat_alloc_output_context2(&made, nullptr, "mp4", part.c_str()), "this kind of film cannot be written");
  format.reset(made);
  format->flags |= AVFMT_FLAG_BITEXACT;  // no times and versions in the file
  must(av().avio_open(&format->pb, part.c_str(), AVIO_FLAG_WRITE), "the film cannot be written");
  const AVCodec* codec = av().avcodec_find_encoder_by_name("libx264");
  if (codec == nullptr)
    throw Error(file.string(), "libavcodec has no encoder libx264", "install a libavcodec with x264");
  coder.reset(av().avcodec_alloc_context3(codec));
  coder->pix_fmt = AV_PIX_FMT_YUV420P;
  coder->time_base = {1, rate};
  coder->framerate = {rate, 1};
  coder->thread_count = 1;  // more would cut the film into other slices
  coder->flags |= AV_CODEC_FLAG_BITEXACT;
  if ((format->oformat->flags & AVFMT_GLOBALHEADER) != 0) coder->flags |= AV_CODEC_FLAG_GLOBAL_HEADER;
  coder->width = even(width);
  coder->height = even(height);
  coder->colorspace = AVCOL_SPC_BT709;
  coder->color_primaries = AVCOL_PRI_BT709;
  coder->color_trc = AVCOL_TRC_BT709;
  coder->color_range = AVCOL_RANGE_MPEG;
  av().av_opt_set(coder->priv_data, "preset", "medium", 0);
  av().av_opt_set(coder->priv_data, "crf", "18", 0);
  must(av().avcodec_open2(coder.get(), nullptr, nullptr), "the encoder refuses this size or rate");
  stream = av().avformat_new_stream(format.get(), nullptr);
  must(av().avcodec_parameters_from_context(stream->codecpar, coder.get()), "the film cannot be described");
  stream->time_base = coder->time_base;
  stream->avg_frame_rate = stream->r_frame_rate = coder->framerate;
  must(av().avformat_write_header(format.get(), nullptr), "the film cannot be written");
  scaler.reset(av().sws_getContext(
      coder->width, coder->height, AV_PIX_FMT_RGB24, coder->width, coder->height, AV_PIX_FMT_YUV420P,
      SWS_BICUBIC | SWS_ACCURATE_RND | SWS_BITEXACT | SWS_FULL_CHR_H_INP, nullptr, nullptr, nullptr));
  if (!scaler) throw Error(file.string(), "libswscale cannot turn RGB into YUV", "install a complete libswscale");
  const int* table = av().sws_getCoefficients(SWS_CS_ITU709);
  av().sws_setColorspaceDetails(scaler.get(), table, 1, table, 0, 0, 1 << 16, 1 << 16);
}

// nullptr: the end.
void VideoWriter::Impl::encode(AVFrame* frame) {
  must(av().avcodec_send_frame(coder.get(), frame), "a picture cannot be encoded");
  while (true) {
    const int code = av().avcodec_receive_packet(coder.get(), packet.get());
    if (code == AVERROR(EAGAIN) || code == AVERROR_EOF) return;
    must(code, "a picture cannot be encoded");
    if (packet->duration == 0) packet->duration = 1;
    av().av_packet_rescale_ts(packet.get(), coder->time_base, stream->time_base);
    packet->stream_index = stream->index;
    must(av().av_interleaved_write_frame(format.get(), packet.get()), "the film cannot be written");
    must(format->pb->error, "the film cannot be written");
  }
}

void VideoWriter::Impl::add(std::span<const std::uint8_t> rgb) {
  const Frame colours = new_frame(coder->width, coder->height, AV_PIX_FMT_RGB24);
  copy_pixels(rgb, width, height, *colours);
  const Frame frame = new_frame(coder->width, coder->height, AV_PIX_FMT_YUV420P);
  av().sws_scale(scaler.get(), colours->data, colours->linesize, 0, colours->height, frame->data, frame->linesize);
  frame->pts = pictures++;
  encode(frame.get());
}

void VideoWriter::Impl::close_file() {
  encode(nullptr);
  must(av().av_write_trailer(format.get()), "the film cannot be written");
  av().avio_flush(format->pb);
  must(format->pb->error, "the film cannot be written");
  must(av().avio_closep(&format->pb), "the film cannot be written");
  format.reset();
  std::ofstream end(part, std::ios::binary | std::ios::app);
  end << film_mark();
  end.close();
  if (!end) throw Error(file.string(), "the film cannot be written", "free some space, or write to another disk");
  output->finish();
}

OutputKind film_kind() {
  return {"a film",
          [](const fs::path& path) {
            std::ifstream file(path, std::ios::binary);
            std::string end(film_mark().size(), ' ');
            file.seekg(-static_cast<std::streamoff>(end.size()), std::ios::end);
            file.read(end.data(), static_cast<std::streamsize>(end.size()));
            return file && end == film_mark();
          },
          true};
}

void VideoWriter::check_name(const fs::path& file) {
  if (file.extension() == ".mp4") return;
  throw Error(file.string(), "a film cannot end in '" + file.extension().string() + "'", "say .mp4");
}

VideoWriter::VideoWriter(const fs::path& file, int width, int height, int rate_hz, const OutputRules& rules)
    : impl_(std::make_unique<Impl>()) {
  check_name(file);
  if (width < 1 || height < 1 || rate_hz < 1) throw Error(file.string(), "a film needs a size and a rate");
  av().av_log_set_level(AV_LOG_QUIET);  // of the whole process: what it would say is in our errors
  impl_->file = file;
  impl_->output = std::make_unique<OutputFile>(file, film_kind(), rules);
  impl_->part = impl_->output->unfinished();
  impl_->width = width;
  impl_->height = height;
  impl_->rate = rate_hz;
  impl_->start();
}

VideoWriter::~VideoWriter() = default;

void VideoWriter::add(std::span<const std::uint8_t> rgb) {
  const auto wanted = static_cast<std::size_t>(impl_->width) * static_cast<std::size_t>(impl_->height) * 3;
  if (rgb.size() != wanted) throw Error(impl_->file.string(), "all pictures of a film have one size");
  impl_->add(rgb);
}

void VideoWriter::finish() {
  if (impl_->pictures == 0) throw Error(impl_->file.string(), "a film needs at least one picture");
  impl_->close_file();
  impl_->finished = true;
}

}  // namespace stampede::program
