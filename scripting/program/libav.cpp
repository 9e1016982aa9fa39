#include "scripting/program/libav.h"

#include "engine/base/late_library.h"

namespace stampede::program {
namespace {

LateLibrary library(const std::string& name, int version) {
  return {name + ".so." + std::to_string(version), "films", "install " + name + std::to_string(version)};
}

LibAv found() {
  LibAv functions;
#define STAMPEDE_LIBAV_FIND(name) from.find(#name, functions.name);
  {
    const LateLibrary from = library("libavutil", LIBAVUTIL_VERSION_MAJOR);
    STAMPEDE_AVUTIL_FUNCTIONS(STAMPEDE_LIBAV_FIND)
  }
  {
    const LateLibrary from = library("libavcodec", LIBAVCODEC_VERSION_MAJOR);
    STAMPEDE_AVCODEC_FUNCTIONS(STAMPEDE_LIBAV_FIND)
  }
  {
    const LateLibrary from = library("libavformat", LIBAVFORMAT_VERSION_MAJOR);
    STAMPEDE_AVFORMAT_FUNCTIONS(STAMPEDE_LIBAV_FIND)
  }
  {
    const LateLibrary from = library("libswscale", LIBSWSCALE_VERSION_MAJOR);
    STAMPEDE_SWSCALE_FUNCTIONS(STAMPEDE_LIBAV_FIND)
  }
#undef STAMPEDE_LIBAV_FIND
  return functions;
}

}  // namespace

const LibAv& av() {
  static const LibAv functions = found();
  return functions;
}

}  // namespace stampede::program
