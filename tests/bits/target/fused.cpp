// Compiled so that it is fused, to see that the look through the disassembly finds it.
double fused(double a, double b, double c) { return a * b + c; }
