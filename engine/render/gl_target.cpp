#include "engine/render/gl_target.h"

#include <array>

#include "engine/base/error.h"

namespace stampede {
namespace {

constexpr long long kKeptPixels = 4096LL * 4096;                          // 200 MB
constexpr std::array<GLfloat, 4> kBackground{0.80F, 0.84F, 0.88F, 1.0F};  // sRGB: a bright, plain wall

}  // namespace

GLuint Targets::attach(GLenum attachment, GLenum format, const TargetKind& kind) {
  GLuint buffer = 0;
  gl_.GenRenderbuffers(1, &buffer);
  gl_.BindRenderbuffer(GL_RENDERBUFFER, buffer);
  gl_.RenderbufferStorage(GL_RENDERBUFFER, format, kind.width, kind.height);
  gl_.FramebufferRenderbuffer(GL_FRAMEBUFFER, attachment, GL_RENDERBUFFER, buffer);
  return buffer;
}

Targets::Target Targets::make(const TargetKind& kind) {
  Target target;
  gl_.GenFramebuffers(1, &target.framebuffer);
  gl_.BindFramebuffer(GL_FRAMEBUFFER, target.framebuffer);
  target.depth = attach(GL_DEPTH_ATTACHMENT, GL_DEPTH_COMPONENT32F, kind);
  if (kind.colours) target.colours = attach(GL_COLOR_ATTACHMENT0, GL_RGBA8, kind);
  if (kind.ids) target.ids = attach(GL_COLOR_ATTACHMENT1, GL_R32UI, kind);
  const std::array<GLenum, 2> buffers{kind.colours ? GLenum{GL_COLOR_ATTACHMENT0} : GLenum{GL_NONE},
                                      kind.ids ? GLenum{GL_COLOR_ATTACHMENT1} : GLenum{GL_NONE}};
  gl_.DrawBuffers(2, buffers.data());
  if (gl_.CheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE)
    throw Error("renderer",
                "there is no memory for a picture of " + std::to_string(kind.width) + " x " +
                    std::to_string(kind.height) + " pixels",
                "ask for a smaller one");
  return target;
}

void Targets::forget() {
  for (const auto& [kind, target] : targets_) {
    gl_.DeleteFramebuffers(1, &target.framebuffer);
    for (const GLuint buffer : {target.depth, target.colours, target.ids})
      if (buffer != 0) gl_.DeleteRenderbuffers(1, &buffer);
  }
  targets_.clear();
  pixels_ = 0;
}

void Targets::bind(const TargetKind& kind) {
  auto found = targets_.find(kind);
  if (found == targets_.end()) {
    const long long pixels = static_cast<long long>(kind.width) * kind.height;
    if (pixels_ + pixels > kKeptPixels) forget();
    found = targets_.emplace(kind, make(kind)).first;
    pixels_ += pixels;
  }
  gl_.BindFramebuffer(GL_FRAMEBUFFER, found->second.framebuffer);
  gl_.Viewport(0, 0, kind.width, kind.height);
  const GLfloat furthest = 0;  // depth is reversed
  const std::array<GLuint, 4> nothing{};
  gl_.ClearBufferfv(GL_DEPTH, 0, &furthest);
  if (kind.colours) gl_.ClearBufferfv(GL_COLOR, 0, kBackground.data());
  if (kind.ids) gl_.ClearBufferuiv(GL_COLOR, 1, nothing.data());
}

}  // namespace stampede
