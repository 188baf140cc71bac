// Feed raster: one invocation of the fragment shader is one fragment.
void main()
{
    uvec2 pixel = uvec2(gl_FragCoord.xy);
    // As the depth test clamps it: interpolation may leave the range where a near plane cuts.
    float depth = fm_hand_on(clamp(gl_FragCoord.z, 0.0, 1.0));
#ifdef FM_PRIMITIVE
    fm_primitive = fm_in_instance * uint(FM_INSTANCE_TRIANGLES) + uint(gl_PrimitiveID);
#endif
    bool is_alive = true;
#ifdef FM_SURVIVAL
    is_alive = fm_survives(pixel, fm_in_layer);
#endif
#if FM_HELPER_GUARD
    // A helper lane's atomics do nothing: it would wait for a lock for ever.
    is_alive = is_alive && !gl_HelperInvocation;
#endif
#if FM_CULL_IN_SHADER
    // Before stencil and blending, as the depth test does it for passes that can have one. Less or equal:
    // a boundary of 1 culls nothing.
    is_alive = is_alive && depth <= fm_load_fm_cull_boundary(pixel).x;
#endif
#if FM_TARGETS
    if (!is_alive)
        discard;
#endif
    if (is_alive)
        fm_arrived();
#if FM_INTERLOCK
    // GLSL allows the two calls in main() only, and not behind a return.
    bool is_wanted = is_alive && (FM_OWN_CULL == 0 || wanted(pixel, depth));
    beginInvocationInterlockARB();
    if (is_wanted)
        store(pixel, depth, fm_in_colour);
    endInvocationInterlockARB();
    if (is_wanted)
        fm_locked();
    else if (is_alive)
        fm_culled();
#else
    if (is_alive)
        fm_take(pixel, depth, fm_in_colour);
#endif
    fm_tell_cut();
}
