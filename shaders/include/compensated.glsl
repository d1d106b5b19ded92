// Adds values with Neumaier's compensated sum (1974), which accumulates the rounding error of each addition separately.
// Knuth's branch-free two-sum computes the error; the result is bit-identical to that of Neumaier's comparison of
// magnitudes. `precise` keeps the compiler from simplifying the error away.

void addCompensated(inout vec3 sum, inout vec3 compensation, vec3 value) {
    precise vec3 total = sum + value;
    precise vec3 taken = total - sum;
    precise vec3 lost = (sum - (total - taken)) + (value - taken);
    precise vec3 next = compensation + lost;
    compensation = next;
    sum = total;
}

void addCompensated(inout float sum, inout float compensation, float value) {
    precise float total = sum + value;
    precise float taken = total - sum;
    precise float lost = (sum - (total - taken)) + (value - taken);
    precise float next = compensation + lost;
    compensation = next;
    sum = total;
}
