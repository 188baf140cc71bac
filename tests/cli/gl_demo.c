/* gl_demo FRAMES: a small OpenGL program to record, of what the recorder has to tell apart: objects
 * with depth on a ground, a panel, blended sprites, an alpha test, a scissor, a depth clear within
 * the frame, a texture that is uploaded anew, something that moves, and a draw call of instances,
 * which is only counted. 320 x 240 px. */
#define GL_GLEXT_PROTOTYPES
#include <GL/gl.h>
#include <GL/glx.h>
#include <X11/Xlib.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

enum { WIDTH = 320, HEIGHT = 240, TEXELS = 16, RING = 12 };

typedef struct window {
    Display *display;
    Window window;
    GLXContext context;
} window;

static int open_window(window *w)
{
    int attributes[] = { GLX_RGBA, GLX_DOUBLEBUFFER, GLX_DEPTH_SIZE, 24, None };
    w->display = XOpenDisplay(NULL);
    XVisualInfo *visual = w->display != NULL ? glXChooseVisual(w->display, 0, attributes) : NULL;
    if (visual == NULL)
        return 0;
    const Window root = DefaultRootWindow(w->display);
    XSetWindowAttributes wanted = { .colormap = XCreateColormap(w->display, root, visual->visual,
                                                                AllocNone) };
    w->window = XCreateWindow(w->display, root, 0, 0, WIDTH, HEIGHT, 0, visual->depth, InputOutput,
                              visual->visual, CWColormap, &wanted);
    w->context = glXCreateContext(w->display, visual, NULL, True);
    XMapWindow(w->display, w->window);
    XSync(w->display, False);
    XFree(visual);
    return glXMakeCurrent(w->display, w->window, w->context);
}

static void close_window(window *w)
{
    glXMakeCurrent(w->display, None, NULL);
    glXDestroyContext(w->display, w->context);
    XDestroyWindow(w->display, w->window);
    XCloseDisplay(w->display);
}

/* A checkerboard; every third square is transparent where asked for. */
static void upload(GLuint texture, unsigned char tint, int has_holes)
{
    unsigned char texels[TEXELS][TEXELS][4];
    for (int y = 0; y < TEXELS; y++)
        for (int x = 0; x < TEXELS; x++) {
            const int square = x / 4 + y / 4;
            texels[y][x][0] = tint;
            texels[y][x][1] = (unsigned char)(square % 2 * 200);
            texels[y][x][2] = 80;
            texels[y][x][3] = has_holes && square % 3 == 0 ? 0 : 255;
        }
    glBindTexture(GL_TEXTURE_2D, texture);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA, TEXELS, TEXELS, 0, GL_RGBA, GL_UNSIGNED_BYTE, texels);
}

static void quad(float x, float y, float side, float z)
{
    const float corners[4][5] = { { 0, 0, x, y, z },
                                  { 1, 0, x + side, y, z },
                                  { 1, 1, x + side, y + side, z },
                                  { 0, 1, x, y + side, z } };
    glInterleavedArrays(GL_T2F_V3F, 0, corners);
    glDrawArrays(GL_QUADS, 0, 4);
}

/* A cone from above: sloped triangles. */
static void cone(float x, float y, float radius, float tip)
{
    glBegin(GL_TRIANGLE_FAN);
    glVertex3f(x, y, tip);
    for (int i = 0; i <= RING; i++) {
        const float angle = (float)i * 6.2831853f / RING;
        glVertex3f(x + radius * cosf(angle), y + radius * sinf(angle), tip - 30);
    }
    glEnd();
}

static void draw_objects(int frame)
{
    glEnable(GL_DEPTH_TEST);
    glDisable(GL_TEXTURE_2D);
    glColor4f(0.3f, 0.5f, 0.3f, 1);
    quad(0, 0, WIDTH, -60);
    for (int i = 0; i < 4; i++) {
        glColor4f(0.2f * (float)i, 0.4f, 0.8f, 1);
        cone(50 + 70 * (float)i, 140, 45, (float)(10 * i));
    }
    glColor4f(0.9f, 0.2f, 0.2f, 1);
    cone(30 + 6 * (float)frame, 60, 25, 20);
}

static void draw_sprites(const GLuint textures[2])
{
    glDisable(GL_DEPTH_TEST);
    glEnable(GL_TEXTURE_2D);
    glEnable(GL_BLEND);
    glBlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
    glColor4f(1, 1, 1, 1);
    glBindTexture(GL_TEXTURE_2D, textures[1]);
    quad(20, 180, 40, 0);
    glDisable(GL_BLEND);
    glEnable(GL_ALPHA_TEST);
    glAlphaFunc(GL_GREATER, 0.5f);
    quad(250, 180, 40, 0);
    glDisable(GL_ALPHA_TEST);
}

/* The panel hides part of what moves; its own small scene has a depth of its own. */
static void draw_panel(const GLuint textures[2])
{
    glBindTexture(GL_TEXTURE_2D, textures[0]);
    glEnable(GL_SCISSOR_TEST);
    glScissor(0, 0, WIDTH, 64);
    quad(0, -200, WIDTH, 0);
    glDisable(GL_SCISSOR_TEST);
    quad(0, 0, 100, 0);
    glClear(GL_DEPTH_BUFFER_BIT);
    glEnable(GL_DEPTH_TEST);
    glDisable(GL_TEXTURE_2D);
    glColor4f(0.9f, 0.9f, 0.1f, 1);
    cone(50, 50, 30, -50);
}

static void draw_instances(void)
{
    const float corners[3][3] = { { 300, 220, 0 }, { 316, 220, 0 }, { 308, 236, 0 } };
    glInterleavedArrays(GL_V3F, 0, corners);
    glDrawArraysInstanced(GL_TRIANGLES, 0, 3, 2);
}

static void draw(const GLuint textures[2], int frame)
{
    glClearColor(0.1f, 0.1f, 0.2f, 1);
    glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
    glMatrixMode(GL_PROJECTION);
    glLoadIdentity();
    glOrtho(0, WIDTH, 0, HEIGHT, -100, 100);
    draw_objects(frame);
    draw_sprites(textures);
    draw_panel(textures);
    draw_instances();
}

int main(int argc, char **argv)
{
    GLuint textures[2];
    window w;
    const int frames = argc > 1 ? atoi(argv[1]) : 16;
    if (!open_window(&w)) {
        fprintf(stderr, "gl_demo: no window\n");
        return 1;
    }
    glGenTextures(2, textures);
    upload(textures[0], 120, 0);
    upload(textures[1], 250, 1);
    for (int i = 0; i < frames; i++) {
        if (i == frames / 2)
            upload(textures[1], 60, 1);
        draw(textures, i);
        glXSwapBuffers(w.display, w.window);
    }
    glDeleteTextures(2, textures);
    close_window(&w);
    return 0;
}
