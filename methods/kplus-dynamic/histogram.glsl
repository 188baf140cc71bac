// histogram[f], f from 1 to DEEPEST: the pixels with f fragments. What is deeper counts as DEEPEST, and its
// fragments above that are summed up in histogram[0], which empty pixels do not need.
const uint DEEPEST = 1023u;
