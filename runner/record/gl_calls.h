/* The real OpenGL and GLX entry points that the recorder calls, looked up behind its own.
 *
 * The folder record is a libGL of our own, which `fragmark record` puts before the real one: it
 * writes what a program draws as a stream of frames. It is not linked into fragmark, and uses base
 * and scene. */
#ifndef FM_RECORD_GL_CALLS_H
#define FM_RECORD_GL_CALLS_H

#include <stdbool.h>

#define GL_GLEXT_PROTOTYPES
#define GLX_GLXEXT_PROTOTYPES
#include <GL/gl.h>
#include <GL/glx.h>

#include <GL/glext.h>

#include "unseen_calls.h"

#define RECORD_GL_CALLS(X)                                                                         \
    X(glActiveTexture)                                                                             \
    X(glBegin)                                                                                     \
    X(glBindTexture)                                                                               \
    X(glCallList)                                                                                  \
    X(glCallLists)                                                                                 \
    X(glClear)                                                                                     \
    X(glCompressedTexImage2D)                                                                      \
    X(glCompressedTexSubImage2D)                                                                   \
    X(glCopyTexImage2D)                                                                            \
    X(glCopyTexSubImage2D)                                                                         \
    X(glDrawArrays)                                                                                \
    X(glDrawElements)                                                                              \
    X(glDrawElementsBaseVertex)                                                                    \
    X(glDrawRangeElements)                                                                         \
    X(glEnd)                                                                                       \
    X(glEndList)                                                                                   \
    X(glFeedbackBuffer)                                                                            \
    X(glGetActiveUniform)                                                                          \
    X(glGetAttachedShaders)                                                                        \
    X(glGetBooleanv)                                                                               \
    X(glGetError)                                                                                  \
    X(glGetFloatv)                                                                                 \
    X(glGetFramebufferAttachmentParameteriv)                                                       \
    X(glGetIntegerv)                                                                               \
    X(glGetProgramiv)                                                                              \
    X(glGetShaderSource)                                                                           \
    X(glGetTexEnviv)                                                                               \
    X(glGetTexImage)                                                                               \
    X(glGetTexLevelParameteriv)                                                                    \
    X(glGetUniformLocation)                                                                        \
    X(glGetUniformfv)                                                                              \
    X(glIsEnabled)                                                                                 \
    X(glMultiDrawArrays)                                                                           \
    X(glMultiDrawElements)                                                                         \
    X(glDrawRangeElementsBaseVertex)                                                               \
    X(glNewList)                                                                                   \
    X(glRenderMode)                                                                                \
    X(glTexImage2D)                                                                                \
    X(glTexSubImage2D)                                                                             \
    X(glXGetCurrentDrawable)                                                                       \
    X(glXGetProcAddress)                                                                           \
    X(glXQueryDrawable)                                                                            \
    X(glXSwapBuffers)

typedef struct gl_calls {
#define RECORD_MEMBER(name)                               __typeof__(name) *name;
#define RECORD_UNSEEN_MEMBER(name, parameters, arguments) RECORD_MEMBER(name)
    RECORD_GL_CALLS(RECORD_MEMBER) RECORD_UNSEEN_CALLS(RECORD_UNSEEN_MEMBER)
#undef RECORD_UNSEEN_MEMBER
#undef RECORD_MEMBER
} gl_calls;

/* false: an entry point is missing. Whatever the table names exists in every desktop OpenGL that
 * knows feedback mode and shaders. */
bool gl_calls_open(gl_calls *gl);

#endif
