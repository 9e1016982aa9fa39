// An OpenGL context without a display: Mesa's llvmpipe through OSMesa.
#pragma once

#include <memory>

#include "engine/render/gl_functions.h"

namespace stampede {

// Lifetime: used by the thread that made it; several may live in one thread, so make_current before each use.
// Throws Error where no OpenGL 4.5 core context can be had.
class GlContext {
 public:
  GlContext();
  ~GlContext();
  GlContext(const GlContext&) = delete;
  GlContext& operator=(const GlContext&) = delete;

  void make_current();
  const GlFunctions& gl() const { return gl_; }

 private:
  struct Inside;
  std::unique_ptr<Inside> inside_;
  GlFunctions gl_;
};

}  // namespace stampede
