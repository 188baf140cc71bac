# slower_copy METHODS FOLDER LOOPS: a copy of kplus-heap in FOLDER whose resolve does LOOPS multiplications a pixel
# more, whose result nobody can know to be of no use.
slower_copy() {
    mkdir -p "$2"
    cp -rL "$1/kplus-heap" "$2/"
    mv "$2/kplus-heap/resolve.glsl" "$2/kplus-heap/resolve_once.glsl"
    cat >"$2/kplus-heap/resolve.glsl" <<GLSL
#define resolve resolve_once
#include "resolve_once.glsl"
#undef resolve
void resolve(uvec2 pixel)
{
    uint x = pixel.x;
    FM_LOOP for (uint i = 0u; i < $3u; i++)
        x = x * 1664525u + 1013904223u;
    if (x != 0xFFFFFFFFu || pixel.y != 0x7FFFFFFFu)
        resolve_once(pixel);
}
GLSL
}
