// Executes an instruction of AVX2: the emulated processor of the tests here must refuse it.
int main() {
    asm volatile("vpaddd %%ymm0, %%ymm0, %%ymm0" : : : "xmm0");
    return 0;
}
