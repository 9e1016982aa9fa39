#include "tests/program/film.h"

#include <catch2/catch.hpp>

extern "C" {
#include <libavcodec/avcodec.h>
#include <libavformat/avformat.h>
#include <libswscale/swscale.h>
}

namespace stampede::program {
namespace {

FilmFrame converted(const AVFrame& frame, AVRational time_base) {
  FilmFrame result{frame.width, frame.height, static_cast<double>(frame.best_effort_timestamp) * av_q2d(time_base), {}};
  result.rgb.resize(static_cast<std::size_t>(frame.width * frame.height * 3));
  SwsContext* scaler =
      sws_getContext(frame.width, frame.height, static_cast<AVPixelFormat>(frame.format), frame.width, frame.height,
                     AV_PIX_FMT_RGB24, SWS_BICUBIC | SWS_ACCURATE_RND | SWS_FULL_CHR_H_INT, nullptr, nullptr, nullptr);
  REQUIRE(scaler != nullptr);
  // What the file says of its colours, not what this test knows of them.
  const int* table = sws_getCoefficients(frame.colorspace == AVCOL_SPC_BT709 ? SWS_CS_ITU709 : SWS_CS_DEFAULT);
  sws_setColorspaceDetails(scaler, table, frame.color_range == AVCOL_RANGE_JPEG ? 1 : 0, table, 1, 0, 1 << 16, 1 << 16);
  std::uint8_t* const rows[] = {result.rgb.data()};
  const int strides[] = {frame.width * 3};
  sws_scale(scaler, frame.data, frame.linesize, 0, frame.height, rows, strides);
  sws_freeContext(scaler);
  return result;
}

}  // namespace

Film read_film(const std::string& file) {
  Film film;
  AVFormatContext* format = nullptr;
  REQUIRE(avformat_open_input(&format, file.c_str(), nullptr, nullptr) == 0);
  REQUIRE(avformat_find_stream_info(format, nullptr) >= 0);
  const AVStream& stream = *format->streams[0];
  AVCodecContext* coder = avcodec_alloc_context3(avcodec_find_decoder(stream.codecpar->codec_id));
  REQUIRE(avcodec_parameters_to_context(coder, stream.codecpar) >= 0);
  REQUIRE(avcodec_open2(coder, nullptr, nullptr) == 0);
  AVPacket* packet = av_packet_alloc();
  AVFrame* frame = av_frame_alloc();
  for (bool more = true; more;) {
    more = av_read_frame(format, packet) >= 0;
    if (more) film.duration_s += static_cast<double>(packet->duration) * av_q2d(stream.time_base);
    REQUIRE(avcodec_send_packet(coder, more ? packet : nullptr) >= 0);
    while (avcodec_receive_frame(coder, frame) >= 0) film.frames.push_back(converted(*frame, stream.time_base));
    av_packet_unref(packet);
  }
  av_frame_free(&frame);
  av_packet_free(&packet);
  avcodec_free_context(&coder);
  avformat_close_input(&format);
  return film;
}

}  // namespace stampede::program
