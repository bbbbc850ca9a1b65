// What probes/kernels/summed_area.glsl sums, in GLSL: a table in a buffer, row by row. An invocation sums one row, and in
// another dispatch one column. The C++ counterpart is SummedAreaKernel in probes/summed_area.h.

layout(std430, set = 1, binding = 14) buffer TableNumbers { real tableNumbers[]; };
int tableFirst;
int tableStep;
real tableNumber(int i) { return tableNumbers[tableFirst + i * tableStep]; }
void setTableNumber(int i, real sum) { tableNumbers[tableFirst + i * tableStep] = sum; }
