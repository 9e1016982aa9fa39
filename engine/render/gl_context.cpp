#include "engine/render/gl_context.h"

#include <GL/osmesa.h>

#include <array>
#include <atomic>
#include <cstdlib>
#include <mutex>

#include "engine/base/error.h"
#include "engine/base/late_library.h"

namespace stampede {
namespace {

constexpr int kDummy = 16;  // pixels: OSMesa wants a picture of its own, though only framebuffer objects are drawn

// OSMesa brings LLVM, which takes longer to load than most commands run.
struct OsMesa {
  decltype(&::OSMesaCreateContextAttribs) create = nullptr;
  decltype(&::OSMesaDestroyContext) destroy = nullptr;
  decltype(&::OSMesaMakeCurrent) make_current = nullptr;
  decltype(&::OSMesaGetCurrentContext) current = nullptr;
  decltype(&::OSMesaGetProcAddress) address = nullptr;

  OsMesa() {
    const LateLibrary library("libOSMesa.so.8", "renderer", "install libosmesa6 22 or later");
    library.find("OSMesaCreateContextAttribs", create);
    library.find("OSMesaDestroyContext", destroy);
    library.find("OSMesaMakeCurrent", make_current);
    library.find("OSMesaGetCurrentContext", current);
    library.find("OSMesaGetProcAddress", address);
  }
};

const OsMesa& osmesa() {
  static const OsMesa functions;
  return functions;
}

// llvmpipe reads this when the first context of the process is made. 0: it draws in the thread that calls.
void settle_environment() {
  static std::once_flag once;
  std::call_once(once, [] { setenv("LP_NUM_THREADS", "0", 1); });
}

// A static object may hold a renderer. It goes when the process ends, after what Mesa keeps for all contexts: Mesa is
// loaded later, and what was made last goes first. From then on contexts are left to the process's end.
std::atomic<bool> process_ends = false;

void watch_for_the_end() {
  static std::once_flag once;
  std::call_once(once, [] { std::atexit([] { process_ends = true; }); });
}

}  // namespace

GlFunctions load_gl_functions() {
  GlFunctions gl;
#define STAMPEDE_GL_LOAD(type, name)                              \
  gl.name = reinterpret_cast<type>(osmesa().address("gl" #name)); \
  if (gl.name == nullptr) throw Error("renderer", "OSMesa has no gl" #name, "install libosmesa6 22 or later");
  STAMPEDE_GL_FUNCTIONS(STAMPEDE_GL_LOAD)
#undef STAMPEDE_GL_LOAD
  return gl;
}

struct GlContext::Inside {
  OSMesaContext context = nullptr;
  std::array<unsigned char, 4 * kDummy * kDummy> dummy{};
};

GlContext::GlContext() : inside_(std::make_unique<Inside>()) {
  settle_environment();
  const std::array<int, 13> attributes{OSMESA_FORMAT,
                                       OSMESA_RGBA,
                                       OSMESA_DEPTH_BITS,
                                       0,
                                       OSMESA_PROFILE,
                                       OSMESA_CORE_PROFILE,
                                       OSMESA_CONTEXT_MAJOR_VERSION,
                                       4,
                                       OSMESA_CONTEXT_MINOR_VERSION,
                                       5,
                                       0,
                                       0,
                                       0};
  {
    static std::mutex mutex;  // workers start together, and the first context makes what all of them share
    const std::lock_guard lock(mutex);
    inside_->context = osmesa().create(attributes.data(), nullptr);
  }
  if (inside_->context == nullptr)
    throw Error("renderer", "OSMesa gives no OpenGL 4.5 core context", "install libosmesa6 22 or later");
  make_current();
  gl_ = load_gl_functions();
  watch_for_the_end();
}

GlContext::~GlContext() {
  if (process_ends) return;
  if (osmesa().current() == inside_->context) osmesa().make_current(nullptr, nullptr, 0, 0, 0);
  osmesa().destroy(inside_->context);
}

void GlContext::make_current() {
  if (osmesa().current() == inside_->context) return;
  if (osmesa().make_current(inside_->context, inside_->dummy.data(), GL_UNSIGNED_BYTE, kDummy, kDummy) != GL_TRUE)
    throw Error("renderer", "the OpenGL context cannot be made current", "use a renderer in the thread that made it");
}

}  // namespace stampede
