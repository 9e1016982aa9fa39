// What is drawn into: a framebuffer of exactly one picture's size.
#pragma once

#include <compare>
#include <map>

#include "engine/render/gl_functions.h"

namespace stampede {

struct TargetKind {
  int width = 0, height = 0;
  bool colours = false, ids = false;  // depth always
  friend auto operator<=>(const TargetKind&, const TargetKind&) = default;
};

// Framebuffers by kind, kept for the next picture. Every picture starts at the corner of a framebuffer of its own size:
// in an atlas its rounding would depend on its place, and so on which other cameras are drawn.
class Targets {
 public:
  explicit Targets(const GlFunctions& gl) : gl_(gl) {}
  void bind(const TargetKind& kind);  // and clears it; throws Error when there is no memory for it

 private:
  struct Target {
    GLuint framebuffer = 0, depth = 0, colours = 0, ids = 0;
  };
  Target make(const TargetKind& kind);
  GLuint attach(GLenum attachment, GLenum format, const TargetKind& kind);
  void forget();

  const GlFunctions& gl_;
  std::map<TargetKind, Target> targets_;
  long long pixels_ = 0;
};

}  // namespace stampede
