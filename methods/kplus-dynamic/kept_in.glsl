// The papers' rule is an array up to 16 fragments and a heap above; K is known when the shader runs.
bool in_heap()
{
    return KEPT_IN == KEPT_IN_HEAP || (KEPT_IN == KEPT_IN_RULE && K > 16u);
}
