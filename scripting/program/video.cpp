// The only file, with libav.cpp, that knows libav.
#include "scripting/program/video.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <new>
#include <string>
#include <system_error>
#include <vector>

#include "engine/base/error.h"
#include "scripting/program/libav.h"

namespace stampede::program {
namespace {

namespace fs = std::filesystem;

constexpr int kFastestGif = 50;  // pictures a second

// libav's owners: a pointer to the pointer is what frees it.
template <typename Type, auto Free>
struct Freer {
  void operator()(Type* pointer) const { (av().*Free)(&pointer); }
};
using Frame = std::unique_ptr<AVFrame, Freer<AVFrame, &LibAv::av_frame_free>>;
using Packet = std::unique_ptr<AVPacket, Freer<AVPacket, &LibAv::av_packet_free>>;
using Coder = std::unique_ptr<AVCodecContext, Freer<AVCodecContext, &LibAv::avcodec_free_context>>;
using Graph = std::unique_ptr<AVFilterGraph, Freer<AVFilterGraph, &LibAv::avfilter_graph_free>>;
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
struct CloseFile {
  void operator()(std::FILE* file) const { std::fclose(file); }
};

bool is_gif(const fs::path& file) { return file.extension() == ".gif"; }

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
  fs::path file, part;
  int width = 0, height = 0, rate = 0;
  int keep_each = 1;  // of the pictures that come
  std::int64_t given = 0, kept = 0;
  bool finished = false;
  Format format;
  Coder coder;
  Packet packet{av().av_packet_alloc()};
  AVStream* stream = nullptr;
  std::unique_ptr<SwsContext, FreeScaler> scaler;  // mp4
  std::unique_ptr<std::FILE, CloseFile> spool;     // gif: all pictures, until the palette is known
  Graph palette_graph, colour_graph;               // gif
  AVFilterContext *palette_source = nullptr, *palette_sink = nullptr;

  ~Impl() {
    if (finished) return;
    format.reset();
    std::error_code ignored;
    fs::remove(part, ignored);
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

  void open_file(const char* container);
  void open_coder(const char* name, const char* cure, AVPixelFormat pixels, AVRational time_base);
  void start_mp4();
  void start_gif();
  AVFilterContext* source(AVFilterGraph& graph, const char* name, int wide, int high, AVPixelFormat pixels) const;
  AVFilterContext* sink(AVFilterGraph& graph) const;
  void encode(AVFrame* frame);
  void add_mp4(std::span<const std::uint8_t> rgb);
  void add_gif(std::span<const std::uint8_t> rgb);
  void open_gif_stream();
  void colour_gif();
  void encode_coloured(AVFilterContext& ready);
  void close_file();
};

void VideoWriter::Impl::open_file(const char* container) {
  AVFormatContext* made = nullptr;
  must(av().avformat_alloc_output_context2(&made, nullptr, container, part.c_str()),
       "this kind of film cannot be written");
  format.reset(made);
  format->flags |= AVFMT_FLAG_BITEXACT;  // no times and versions in the file
  must(av().avio_open(&format->pb, part.c_str(), AVIO_FLAG_WRITE), "the film cannot be written");
}

void VideoWriter::Impl::open_coder(const char* name, const char* cure, AVPixelFormat pixels, AVRational time_base) {
  const AVCodec* codec = av().avcodec_find_encoder_by_name(name);
  if (codec == nullptr) throw Error(file.string(), std::string("libavcodec has no encoder ") + name, cure);
  coder.reset(av().avcodec_alloc_context3(codec));
  coder->pix_fmt = pixels;
  coder->time_base = time_base;
  coder->framerate = {rate, keep_each};
  coder->thread_count = 1;  // more would cut the film into other slices
  coder->flags |= AV_CODEC_FLAG_BITEXACT;
  if ((format->oformat->flags & AVFMT_GLOBALHEADER) != 0) coder->flags |= AV_CODEC_FLAG_GLOBAL_HEADER;
}

void VideoWriter::Impl::start_mp4() {
  open_file("mp4");
  open_coder("libx264", "write a .gif instead, or install a libavcodec with x264", AV_PIX_FMT_YUV420P, {1, rate});
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
  if (!scaler) throw Error(file.string(), "libswscale cannot turn RGB into YUV", "write a .gif instead");
  const int* table = av().sws_getCoefficients(SWS_CS_ITU709);
  av().sws_setColorspaceDetails(scaler.get(), table, 1, table, 0, 0, 1 << 16, 1 << 16);
}

AVFilterContext* VideoWriter::Impl::source(AVFilterGraph& graph, const char* name, int wide, int high,
                                           AVPixelFormat pixels) const {
  const std::string options = "video_size=" + std::to_string(wide) + "x" + std::to_string(high) +
                              ":pix_fmt=" + std::to_string(pixels) + ":time_base=" + std::to_string(keep_each) + "/" +
                              std::to_string(rate);
  AVFilterContext* made = nullptr;
  must(av().avfilter_graph_create_filter(&made, av().avfilter_get_by_name("buffer"), name, options.c_str(), nullptr,
                                         &graph),
       "libavfilter cannot take pictures");
  return made;
}

AVFilterContext* VideoWriter::Impl::sink(AVFilterGraph& graph) const {
  AVFilterContext* made = nullptr;
  must(av().avfilter_graph_create_filter(&made, av().avfilter_get_by_name("buffersink"), "out", nullptr, nullptr,
                                         &graph),
       "libavfilter cannot give pictures");
  return made;
}

void VideoWriter::Impl::start_gif() {
  open_file("gif");
  spool.reset(std::tmpfile());
  if (!spool) throw Error(file.string(), "there is no room for a temporary file", "free space in /tmp");
  palette_graph.reset(av().avfilter_graph_alloc());
  palette_graph->nb_threads = 1;
  const AVFilter* palettegen = av().avfilter_get_by_name("palettegen");
  if (palettegen == nullptr || av().avfilter_get_by_name("paletteuse") == nullptr)
    throw Error(file.string(), "libavfilter has no palettegen or no paletteuse", "write an .mp4 instead");
  palette_source = source(*palette_graph, "in", width, height, AV_PIX_FMT_RGB32);
  AVFilterContext* filter = nullptr;
  must(av().avfilter_graph_create_filter(&filter, palettegen, "gen", "reserve_transparent=0", nullptr,
                                         palette_graph.get()),
       "the palette cannot be made");
  palette_sink = sink(*palette_graph);
  must(av().avfilter_link(palette_source, 0, filter, 0), "the palette cannot be made");
  must(av().avfilter_link(filter, 0, palette_sink, 0), "the palette cannot be made");
  must(av().avfilter_graph_config(palette_graph.get(), nullptr), "the palette cannot be made");
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

void VideoWriter::Impl::add_mp4(std::span<const std::uint8_t> rgb) {
  const Frame colours = new_frame(coder->width, coder->height, AV_PIX_FMT_RGB24);
  copy_pixels(rgb, width, height, *colours);
  const Frame frame = new_frame(coder->width, coder->height, AV_PIX_FMT_YUV420P);
  av().sws_scale(scaler.get(), colours->data, colours->linesize, 0, colours->height, frame->data, frame->linesize);
  frame->pts = kept;
  encode(frame.get());
}

// 0xAARRGGBB in the machine's order, which is what the palette filters take.
Frame packed_frame(std::span<const std::uint8_t> rgb, int width, int height) {
  Frame frame = new_frame(width, height, AV_PIX_FMT_RGB32);
  for (int y = 0; y < height; ++y) {
    auto* to = reinterpret_cast<std::uint32_t*>(frame->data[0] + static_cast<std::ptrdiff_t>(y) * frame->linesize[0]);
    const std::uint8_t* from = rgb.data() + static_cast<std::ptrdiff_t>(y) * width * 3;
    for (int x = 0; x < width; ++x, from += 3)
      to[x] =
          0xFF000000U | static_cast<std::uint32_t>(from[0]) << 16 | static_cast<std::uint32_t>(from[1]) << 8 | from[2];
  }
  return frame;
}

void VideoWriter::Impl::add_gif(std::span<const std::uint8_t> rgb) {
  if (std::fwrite(rgb.data(), 1, rgb.size(), spool.get()) != rgb.size())
    throw Error(file.string(), "the temporary file for its pictures cannot be written", "free space in /tmp");
  const Frame frame = packed_frame(rgb, width, height);
  frame->pts = kept;
  must(av().av_buffersrc_add_frame(palette_source, frame.get()), "the palette cannot be made");
}

void VideoWriter::Impl::open_gif_stream() {
  open_coder("gif", "write an .mp4 instead", AV_PIX_FMT_PAL8, {1, 100});
  coder->width = width;
  coder->height = height;
  must(av().avcodec_open2(coder.get(), nullptr, nullptr), "the encoder refuses this size or rate");
  stream = av().avformat_new_stream(format.get(), nullptr);
  must(av().avcodec_parameters_from_context(stream->codecpar, coder.get()), "the film cannot be described");
  stream->time_base = coder->time_base;
  must(av().avformat_write_header(format.get(), nullptr), "the film cannot be written");
}

// What the filters have ready.
void VideoWriter::Impl::encode_coloured(AVFilterContext& ready) {
  while (true) {
    const Frame coloured(av().av_frame_alloc());
    const int code = av().av_buffersink_get_frame(&ready, coloured.get());
    if (code == AVERROR(EAGAIN) || code == AVERROR_EOF) return;
    must(code, "the palette cannot be used");
    const std::int64_t number = coloured->pts;
    coloured->pts = av().av_rescale(number, 100 * keep_each, rate);
    coloured->pkt_duration = av().av_rescale(number + 1, 100 * keep_each, rate) - coloured->pts;
    encode(coloured.get());
  }
}

// The pictures once more, now that the palette is known.
void VideoWriter::Impl::colour_gif() {
  must(av().av_buffersrc_add_frame(palette_source, nullptr), "the palette cannot be made");
  const Frame palette(av().av_frame_alloc());
  must(av().av_buffersink_get_frame(palette_sink, palette.get()), "the palette cannot be made");
  colour_graph.reset(av().avfilter_graph_alloc());
  colour_graph->nb_threads = 1;
  AVFilterContext* const pictures = source(*colour_graph, "in", width, height, AV_PIX_FMT_RGB32);
  AVFilterContext* const colours = source(*colour_graph, "colours", palette->width, palette->height, AV_PIX_FMT_RGB32);
  AVFilterContext* filter = nullptr;
  must(av().avfilter_graph_create_filter(&filter, av().avfilter_get_by_name("paletteuse"), "use", "diff_mode=rectangle",
                                         nullptr, colour_graph.get()),
       "the palette cannot be used");
  AVFilterContext* const out = sink(*colour_graph);
  for (const int code :
       {av().avfilter_link(pictures, 0, filter, 0), av().avfilter_link(colours, 0, filter, 1),
        av().avfilter_link(filter, 0, out, 0), av().avfilter_graph_config(colour_graph.get(), nullptr)})
    must(code, "the palette cannot be used");
  open_gif_stream();
  palette->pts = 0;
  must(av().av_buffersrc_add_frame(colours, palette.get()), "the palette cannot be used");
  must(av().av_buffersrc_add_frame(colours, nullptr), "the palette cannot be used");

  std::rewind(spool.get());
  std::vector<std::uint8_t> rgb(static_cast<std::size_t>(width) * static_cast<std::size_t>(height) * 3);
  for (std::int64_t i = 0; i < kept; ++i) {
    if (std::fread(rgb.data(), 1, rgb.size(), spool.get()) != rgb.size())
      throw Error(file.string(), "the temporary file for its pictures cannot be read");
    const Frame frame = packed_frame(rgb, width, height);
    frame->pts = i;
    must(av().av_buffersrc_add_frame(pictures, frame.get()), "the palette cannot be used");
    encode_coloured(*out);
  }
  must(av().av_buffersrc_add_frame(pictures, nullptr), "the palette cannot be used");
  encode_coloured(*out);
}

void VideoWriter::Impl::close_file() {
  encode(nullptr);
  must(av().av_write_trailer(format.get()), "the film cannot be written");
  av().avio_flush(format->pb);
  must(format->pb->error, "the film cannot be written");
  must(av().avio_closep(&format->pb), "the film cannot be written");
  format.reset();
  std::error_code error;
  fs::rename(part, file, error);
  if (error) throw Error(file.string(), "the film cannot be written: " + error.message());
}

void VideoWriter::check_name(const fs::path& file) {
  if (file.extension() == ".mp4" || is_gif(file)) return;
  throw Error(file.string(), "a film cannot end in '" + file.extension().string() + "'", "say .mp4 or .gif");
}

VideoWriter::VideoWriter(const fs::path& file, int width, int height, int rate_hz) : impl_(std::make_unique<Impl>()) {
  check_name(file);
  if (width < 1 || height < 1 || rate_hz < 1) throw Error(file.string(), "a film needs a size and a rate");
  av().av_log_set_level(AV_LOG_QUIET);  // of the whole process: what it would say is in our errors
  impl_->file = file;
  impl_->part = file.string() + ".part";
  impl_->width = width;
  impl_->height = height;
  impl_->rate = rate_hz;
  if (is_gif(file)) {
    impl_->keep_each = (rate_hz + kFastestGif - 1) / kFastestGif;
    impl_->start_gif();
  } else {
    impl_->start_mp4();
  }
}

VideoWriter::~VideoWriter() = default;

void VideoWriter::add(std::span<const std::uint8_t> rgb) {
  const auto wanted = static_cast<std::size_t>(impl_->width) * static_cast<std::size_t>(impl_->height) * 3;
  if (rgb.size() != wanted) throw Error(impl_->file.string(), "all pictures of a film have one size");
  if (impl_->given++ % impl_->keep_each != 0) return;
  if (impl_->spool) {
    impl_->add_gif(rgb);
  } else {
    impl_->add_mp4(rgb);
  }
  ++impl_->kept;
}

void VideoWriter::finish() {
  if (impl_->kept == 0) throw Error(impl_->file.string(), "a film needs at least one picture");
  if (impl_->spool) impl_->colour_gif();
  impl_->close_file();
  impl_->finished = true;
}

}  // namespace stampede::program
