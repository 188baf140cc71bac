/* Exports something, but no fm_method. */
__attribute__((visibility("default"))) extern const int another_symbol;
const int another_symbol = 1;
