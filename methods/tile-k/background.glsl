// Where nothing is listed nothing is drawn: all pixels begin empty, and have emitted nothing so far.
void background(uvec2 pixel)
{
}
