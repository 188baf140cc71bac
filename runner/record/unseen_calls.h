/* What draws and is not recorded, only passed on and counted: X(name, (parameters), (arguments)).
 * Instances, parameters that lie in buffers, rectangles of pixels, and old ways to draw. */
#ifndef FM_RECORD_UNSEEN_CALLS_H
#define FM_RECORD_UNSEEN_CALLS_H

/* clang-format off */
#define RECORD_UNSEEN_CALLS(X) \
    X(glDrawArraysInstanced, (GLenum mode, GLint first, GLsizei count, GLsizei instances), \
      (mode, first, count, instances)) \
    X(glDrawArraysInstancedBaseInstance, \
      (GLenum mode, GLint first, GLsizei count, GLsizei instances, GLuint base), \
      (mode, first, count, instances, base)) \
    X(glDrawElementsInstanced, \
      (GLenum mode, GLsizei count, GLenum type, const void *indices, GLsizei instances), \
      (mode, count, type, indices, instances)) \
    X(glDrawElementsInstancedBaseVertex, \
      (GLenum mode, GLsizei count, GLenum type, const void *indices, GLsizei instances, GLint vertex), \
      (mode, count, type, indices, instances, vertex)) \
    X(glDrawElementsInstancedBaseInstance, \
      (GLenum mode, GLsizei count, GLenum type, const void *indices, GLsizei instances, GLuint base), \
      (mode, count, type, indices, instances, base)) \
    X(glDrawElementsInstancedBaseVertexBaseInstance, \
      (GLenum mode, GLsizei count, GLenum type, const void *indices, GLsizei instances, GLint vertex, \
       GLuint base), \
      (mode, count, type, indices, instances, vertex, base)) \
    X(glDrawArraysIndirect, (GLenum mode, const void *where), (mode, where)) \
    X(glDrawElementsIndirect, (GLenum mode, GLenum type, const void *where), (mode, type, where)) \
    X(glMultiDrawArraysIndirect, (GLenum mode, const void *where, GLsizei draws, GLsizei stride), \
      (mode, where, draws, stride)) \
    X(glMultiDrawElementsIndirect, \
      (GLenum mode, GLenum type, const void *where, GLsizei draws, GLsizei stride), \
      (mode, type, where, draws, stride)) \
    X(glDrawTransformFeedback, (GLenum mode, GLuint id), (mode, id)) \
    X(glDrawTransformFeedbackInstanced, (GLenum mode, GLuint id, GLsizei instances), \
      (mode, id, instances)) \
    X(glDrawTransformFeedbackStream, (GLenum mode, GLuint id, GLuint stream), (mode, id, stream)) \
    X(glDrawTransformFeedbackStreamInstanced, \
      (GLenum mode, GLuint id, GLuint stream, GLsizei instances), (mode, id, stream, instances)) \
    X(glEvalMesh1, (GLenum mode, GLint first, GLint last), (mode, first, last)) \
    X(glEvalMesh2, (GLenum mode, GLint left, GLint right, GLint low, GLint high), \
      (mode, left, right, low, high)) \
    X(glRectd, (GLdouble left, GLdouble low, GLdouble right, GLdouble high), \
      (left, low, right, high)) \
    X(glRectf, (GLfloat left, GLfloat low, GLfloat right, GLfloat high), (left, low, right, high)) \
    X(glRecti, (GLint left, GLint low, GLint right, GLint high), (left, low, right, high)) \
    X(glRects, (GLshort left, GLshort low, GLshort right, GLshort high), (left, low, right, high)) \
    X(glRectdv, (const GLdouble *one, const GLdouble *other), (one, other)) \
    X(glRectfv, (const GLfloat *one, const GLfloat *other), (one, other)) \
    X(glRectiv, (const GLint *one, const GLint *other), (one, other)) \
    X(glRectsv, (const GLshort *one, const GLshort *other), (one, other)) \
    X(glDrawPixels, \
      (GLsizei width, GLsizei height, GLenum format, GLenum type, const void *pixels), \
      (width, height, format, type, pixels)) \
    X(glCopyPixels, (GLint x, GLint y, GLsizei width, GLsizei height, GLenum type), \
      (x, y, width, height, type)) \
    X(glBitmap, \
      (GLsizei width, GLsizei height, GLfloat x, GLfloat y, GLfloat step_x, GLfloat step_y, \
       const GLubyte *bits), \
      (width, height, x, y, step_x, step_y, bits)) \
    X(glBlitFramebuffer, \
      (GLint x0, GLint y0, GLint x1, GLint y1, GLint to_x0, GLint to_y0, GLint to_x1, GLint to_y1, \
       GLbitfield mask, GLenum filter), \
      (x0, y0, x1, y1, to_x0, to_y0, to_x1, to_y1, mask, filter))
/* clang-format on */

#endif
