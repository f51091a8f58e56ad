/* What C's own operators and functions do otherwise than Python's; `c_expressions` takes those that
   a text needs. */

static inline double larger(double a, double b) {
    return b > a ? b : a;
}

static inline double smaller(double a, double b) {
    return b < a ? b : a;
}

static inline int64_t larger_int(int64_t a, int64_t b) {
    return b > a ? b : a;
}

static inline int64_t smaller_int(int64_t a, int64_t b) {
    return b < a ? b : a;
}

static inline int64_t absolute_int(int64_t a) {
    return a < 0 ? -a : a;
}

static inline double radians(double degrees) {
    return degrees * (3.141592653589793 / 180.0);
}

/* What is left of a after whole b, with the sign of b. */
static inline int64_t modulo_int(int64_t a, int64_t b) {
    const int64_t left = a % b;
    return left != 0 && (left < 0) != (b < 0) ? left + b : left;
}

/* The largest whole number up to a / b. */
static inline int64_t floor_divide_int(int64_t a, int64_t b) {
    const int64_t left = a % b;
    return a / b - (left != 0 && (left < 0) != (b < 0) ? 1 : 0);
}

/* What is left of a after whole b, with the sign of b. */
static inline double modulo(double a, double b) {
    const double left = fmod(a, b);
    if (left == 0.0) {
        return copysign(0.0, b);
    }
    return (left < 0.0) != (b < 0.0) ? left + b : left;
}

/* The largest whole number up to a / b, of a quotient that has been made exact before. */
static inline double floor_divide(double a, double b) {
    const double left = fmod(a, b);
    double quotient = (a - left) / b;
    if (left != 0.0 && (left < 0.0) != (b < 0.0)) {
        quotient -= 1.0;
    }
    if (quotient == 0.0) {
        return copysign(0.0, a / b);
    }
    const double whole = floor(quotient);
    return quotient - whole > 0.5 ? whole + 1.0 : whole;
}
