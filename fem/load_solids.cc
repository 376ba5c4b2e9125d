#include "fem/load_solids.h"

// In a file of its own: a program that defines the function does not take this one.
void platen::fem::load_solids() {}
