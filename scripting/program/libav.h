// The functions of libav that films are made with, found in its libraries when the first film is: they bring a hundred
// others, which take longer to load than most commands run.
#pragma once

extern "C" {
#include <libavcodec/avcodec.h>
#include <libavformat/avformat.h>
#include <libavutil/opt.h>
#include <libswscale/swscale.h>
}

// What it makes of these lists is another thing each time.
// clang-format off
#define STAMPEDE_AVUTIL_FUNCTIONS(X) \
  X(av_frame_alloc)                  \
  X(av_frame_free) X(av_frame_get_buffer) X(av_log_set_level) X(av_opt_set) X(av_strerror)

#define STAMPEDE_AVCODEC_FUNCTIONS(X)                                                                   \
  X(av_packet_alloc)                                                                                    \
  X(av_packet_free)                                                                                     \
  X(av_packet_rescale_ts)                                                                               \
  X(avcodec_alloc_context3)                                                                             \
  X(avcodec_find_encoder_by_name)                                                                       \
  X(avcodec_free_context) X(avcodec_open2) X(avcodec_parameters_from_context) X(avcodec_receive_packet) \
      X(avcodec_send_frame)

#define STAMPEDE_AVFORMAT_FUNCTIONS(X) \
  X(av_interleaved_write_frame)        \
  X(av_write_trailer)                  \
  X(avformat_alloc_output_context2)    \
  X(avformat_free_context) X(avformat_new_stream) X(avformat_write_header) X(avio_closep) X(avio_flush) X(avio_open)

#define STAMPEDE_SWSCALE_FUNCTIONS(X) \
  X(sws_freeContext) X(sws_getCoefficients) X(sws_getContext) X(sws_scale) X(sws_setColorspaceDetails)
// clang-format on

namespace stampede::program {

struct LibAv {
#define STAMPEDE_LIBAV_MEMBER(name) decltype(&::name) name = nullptr;
  STAMPEDE_AVUTIL_FUNCTIONS(STAMPEDE_LIBAV_MEMBER)
  STAMPEDE_AVCODEC_FUNCTIONS(STAMPEDE_LIBAV_MEMBER)
  STAMPEDE_AVFORMAT_FUNCTIONS(STAMPEDE_LIBAV_MEMBER)
  STAMPEDE_SWSCALE_FUNCTIONS(STAMPEDE_LIBAV_MEMBER)
#undef STAMPEDE_LIBAV_MEMBER
};

// Lifetime: the process. Throws Error, with the package to install, where one of the libraries is missing: those of
// another release than this was built with are missing too.
const LibAv& av();

}  // namespace stampede::program
