// Compiled with contraction, to show that scripts/check_instructions sees a fused multiply-add.
float contracted(float a, float b, float c) { return a * b + c; }
