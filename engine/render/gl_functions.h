// The functions of OpenGL that are used here, looked up by name: OSMesa exports no core profile to link against.
#pragma once

#include <GL/glcorearb.h>

namespace stampede {

// A member is named as the function without its `gl`: `gl.draw_elements` would hide what the books call it.
#define STAMPEDE_GL_FUNCTIONS(GL)                               \
  GL(PFNGLACTIVETEXTUREPROC, ActiveTexture)                     \
  GL(PFNGLATTACHSHADERPROC, AttachShader)                       \
  GL(PFNGLBINDBUFFERPROC, BindBuffer)                           \
  GL(PFNGLBINDFRAMEBUFFERPROC, BindFramebuffer)                 \
  GL(PFNGLBINDRENDERBUFFERPROC, BindRenderbuffer)               \
  GL(PFNGLBINDTEXTUREPROC, BindTexture)                         \
  GL(PFNGLBINDVERTEXARRAYPROC, BindVertexArray)                 \
  GL(PFNGLBLENDFUNCPROC, BlendFunc)                             \
  GL(PFNGLBUFFERDATAPROC, BufferData)                           \
  GL(PFNGLBUFFERSUBDATAPROC, BufferSubData)                     \
  GL(PFNGLCHECKFRAMEBUFFERSTATUSPROC, CheckFramebufferStatus)   \
  GL(PFNGLCLEARBUFFERFVPROC, ClearBufferfv)                     \
  GL(PFNGLCLEARBUFFERUIVPROC, ClearBufferuiv)                   \
  GL(PFNGLCLIPCONTROLPROC, ClipControl)                         \
  GL(PFNGLCOLORMASKIPROC, ColorMaski)                           \
  GL(PFNGLDISABLEIPROC, Disablei)                               \
  GL(PFNGLENABLEIPROC, Enablei)                                 \
  GL(PFNGLPOLYGONOFFSETPROC, PolygonOffset)                     \
  GL(PFNGLCOMPILESHADERPROC, CompileShader)                     \
  GL(PFNGLCREATEPROGRAMPROC, CreateProgram)                     \
  GL(PFNGLCREATESHADERPROC, CreateShader)                       \
  GL(PFNGLCULLFACEPROC, CullFace)                               \
  GL(PFNGLDELETEFRAMEBUFFERSPROC, DeleteFramebuffers)           \
  GL(PFNGLDELETERENDERBUFFERSPROC, DeleteRenderbuffers)         \
  GL(PFNGLDELETESHADERPROC, DeleteShader)                       \
  GL(PFNGLDELETETEXTURESPROC, DeleteTextures)                   \
  GL(PFNGLDEPTHFUNCPROC, DepthFunc)                             \
  GL(PFNGLDEPTHMASKPROC, DepthMask)                             \
  GL(PFNGLDISABLEPROC, Disable)                                 \
  GL(PFNGLDRAWBUFFERSPROC, DrawBuffers)                         \
  GL(PFNGLDRAWELEMENTSPROC, DrawElements)                       \
  GL(PFNGLENABLEPROC, Enable)                                   \
  GL(PFNGLENABLEVERTEXATTRIBARRAYPROC, EnableVertexAttribArray) \
  GL(PFNGLFRAMEBUFFERRENDERBUFFERPROC, FramebufferRenderbuffer) \
  GL(PFNGLFRAMEBUFFERTEXTURE2DPROC, FramebufferTexture2D)       \
  GL(PFNGLFRONTFACEPROC, FrontFace)                             \
  GL(PFNGLGENBUFFERSPROC, GenBuffers)                           \
  GL(PFNGLGENFRAMEBUFFERSPROC, GenFramebuffers)                 \
  GL(PFNGLGENRENDERBUFFERSPROC, GenRenderbuffers)               \
  GL(PFNGLGENTEXTURESPROC, GenTextures)                         \
  GL(PFNGLGENVERTEXARRAYSPROC, GenVertexArrays)                 \
  GL(PFNGLGENERATEMIPMAPPROC, GenerateMipmap)                   \
  GL(PFNGLGETERRORPROC, GetError)                               \
  GL(PFNGLGETPROGRAMINFOLOGPROC, GetProgramInfoLog)             \
  GL(PFNGLGETPROGRAMIVPROC, GetProgramiv)                       \
  GL(PFNGLGETSHADERINFOLOGPROC, GetShaderInfoLog)               \
  GL(PFNGLGETSHADERIVPROC, GetShaderiv)                         \
  GL(PFNGLGETUNIFORMLOCATIONPROC, GetUniformLocation)           \
  GL(PFNGLLINKPROGRAMPROC, LinkProgram)                         \
  GL(PFNGLPIXELSTOREIPROC, PixelStorei)                         \
  GL(PFNGLREADBUFFERPROC, ReadBuffer)                           \
  GL(PFNGLREADPIXELSPROC, ReadPixels)                           \
  GL(PFNGLRENDERBUFFERSTORAGEPROC, RenderbufferStorage)         \
  GL(PFNGLSHADERSOURCEPROC, ShaderSource)                       \
  GL(PFNGLTEXIMAGE2DPROC, TexImage2D)                           \
  GL(PFNGLTEXPARAMETERFVPROC, TexParameterfv)                   \
  GL(PFNGLTEXPARAMETERIPROC, TexParameteri)                     \
  GL(PFNGLUNIFORM1FPROC, Uniform1f)                             \
  GL(PFNGLUNIFORM1IPROC, Uniform1i)                             \
  GL(PFNGLUNIFORM3FVPROC, Uniform3fv)                           \
  GL(PFNGLUNIFORMMATRIX4FVPROC, UniformMatrix4fv)               \
  GL(PFNGLUSEPROGRAMPROC, UseProgram)                           \
  GL(PFNGLVERTEXATTRIBIPOINTERPROC, VertexAttribIPointer)       \
  GL(PFNGLVERTEXATTRIBPOINTERPROC, VertexAttribPointer)         \
  GL(PFNGLVIEWPORTPROC, Viewport)

struct GlFunctions {
#define STAMPEDE_GL_MEMBER(type, name) type name = nullptr;
  STAMPEDE_GL_FUNCTIONS(STAMPEDE_GL_MEMBER)
#undef STAMPEDE_GL_MEMBER
};

// Of the context that is current. Throws Error when one is missing.
GlFunctions load_gl_functions();

}  // namespace stampede
