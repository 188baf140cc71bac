/* The OpenGL 4.5 entry points that this device calls, as a table a device carries.
 *
 * They come from OSMesaGetProcAddress: loaders such as GLEW and libepoxy know GLX and EGL only.
 * The prototypes are declared for the types of the table's members; nothing links to them. */
#ifndef FM_OSMESA_GL_H
#define FM_OSMESA_GL_H

#define GL_GLEXT_PROTOTYPES
#include <GL/osmesa.h>

#include <GL/glext.h>

#include "base/error.h"
#include "library.h"

#define FM_GL_FUNCTIONS(X)                                                                         \
    X(AttachShader)                                                                                \
    X(BeginQuery)                                                                                  \
    X(BindBuffer)                                                                                  \
    X(BindBufferBase)                                                                              \
    X(BindFramebuffer)                                                                             \
    X(BindImageTexture)                                                                            \
    X(BindTextureUnit)                                                                             \
    X(BindVertexArray)                                                                             \
    X(BlendEquationi)                                                                              \
    X(BlendFuncSeparatei)                                                                          \
    X(CheckNamedFramebufferStatus)                                                                 \
    X(ClearBufferfi)                                                                               \
    X(ClearBufferfv)                                                                               \
    X(ClearBufferuiv)                                                                              \
    X(ClearNamedBufferData)                                                                        \
    X(ClipControl)                                                                                 \
    X(ColorMask)                                                                                   \
    X(ColorMaski)                                                                                  \
    X(CompileShader)                                                                               \
    X(CreateBuffers)                                                                               \
    X(CreateFramebuffers)                                                                          \
    X(CreateProgram)                                                                               \
    X(CreateQueries)                                                                               \
    X(CreateShader)                                                                                \
    X(CreateTextures)                                                                              \
    X(CreateVertexArrays)                                                                          \
    X(DebugMessageCallback)                                                                        \
    X(DeleteBuffers)                                                                               \
    X(DeleteFramebuffers)                                                                          \
    X(DeleteProgram)                                                                               \
    X(DeleteQueries)                                                                               \
    X(DeleteShader)                                                                                \
    X(DeleteTextures)                                                                              \
    X(DeleteVertexArrays)                                                                          \
    X(DepthFunc)                                                                                   \
    X(DepthMask)                                                                                   \
    X(Disable)                                                                                     \
    X(Disablei)                                                                                    \
    X(DispatchCompute)                                                                             \
    X(DispatchComputeIndirect)                                                                     \
    X(DrawArraysInstanced)                                                                         \
    X(DrawElementsInstanced)                                                                       \
    X(Enable)                                                                                      \
    X(EnableVertexArrayAttrib)                                                                     \
    X(Enablei)                                                                                     \
    X(EndQuery)                                                                                    \
    X(Finish)                                                                                      \
    X(GetError)                                                                                    \
    X(GetInteger64v)                                                                               \
    X(GetIntegeri_v)                                                                               \
    X(GetIntegerv)                                                                                 \
    X(GetInternalformativ)                                                                         \
    X(GetNamedBufferSubData)                                                                       \
    X(GetProgramInfoLog)                                                                           \
    X(GetProgramiv)                                                                                \
    X(GetQueryObjectui64v)                                                                         \
    X(GetShaderInfoLog)                                                                            \
    X(GetShaderiv)                                                                                 \
    X(GetString)                                                                                   \
    X(GetStringi)                                                                                  \
    X(LinkProgram)                                                                                 \
    X(MemoryBarrier)                                                                               \
    X(NamedBufferStorage)                                                                          \
    X(NamedBufferSubData)                                                                          \
    X(NamedFramebufferDrawBuffers)                                                                 \
    X(NamedFramebufferParameteri)                                                                  \
    X(NamedFramebufferTexture)                                                                     \
    X(NamedFramebufferTextureLayer)                                                                \
    X(ProvokingVertex)                                                                             \
    X(QueryCounter)                                                                                \
    X(SampleMaski)                                                                                 \
    X(Scissor)                                                                                     \
    X(ShaderSource)                                                                                \
    X(StencilFunc)                                                                                 \
    X(StencilMask)                                                                                 \
    X(StencilOp)                                                                                   \
    X(TextureParameteri)                                                                           \
    X(TextureStorage2D)                                                                            \
    X(TextureStorage2DMultisample)                                                                 \
    X(TextureStorage3D)                                                                            \
    X(TextureStorage3DMultisample)                                                                 \
    X(UseProgram)                                                                                  \
    X(VertexArrayAttribBinding)                                                                    \
    X(VertexArrayAttribFormat)                                                                     \
    X(VertexArrayAttribIFormat)                                                                    \
    X(VertexArrayElementBuffer)                                                                    \
    X(VertexArrayVertexBuffer)                                                                     \
    X(Viewport)

typedef struct fm_gl {
#define FM_GL_MEMBER(name) __typeof__(gl##name) *name;
    FM_GL_FUNCTIONS(FM_GL_MEMBER)
#undef FM_GL_MEMBER
} fm_gl;

/* Fills the table; a context must be current. FM_UNSUPPORTED names a function that is missing. */
fm_status gl_load(fm_gl *gl, const osmesa_library *library, fm_error *err);

/* "GL_INVALID_OPERATION", or "an unknown OpenGL error". */
const char *gl_error_name(GLenum code);

/* What came of asking OpenGL for storage of `bytes`. FM_NO_MEMORY, or FM_DEVICE_LOST for an error
 * that should not be, with a message that begins with KIND 'NAME': "image 'slots': no room ...". */
fm_status gl_check_storage(const fm_gl *gl, const char *kind, const char *name, uint64_t bytes,
                           fm_error *err);

#endif
