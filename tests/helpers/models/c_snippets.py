"""Each means of the kernel's text beside those of random expressions: what becomes C."""

SNIPPETS = '''
"""A heading."""
from math import atan2, ceil, copysign, cos, floor, isfinite, isinf, isnan, log1p, pi, radians, sin

HALF = 0.5
THREE = 3
MANY = 5000000000
BACK = -2
ON = True
HUGE = 1e200
KNOTS = (0.25, -1.5, 3, 1e-300)

def signs(a: float, b: float) -> float:
    return -a ** 2 - -b + a * -b - -(-a) + (-a) ** 2 - 2.0 ** -b + +a

def powers(a: float, b: float) -> float:
    """Ends a comment */ and begins one /* too."""
    return a ** 2 + abs(a) ** b + a ** -1 + b ** 0.5 + a ** THREE

def division(a: float, i: int, j: int) -> float:
    return i / j + a / i + 1 / 3 + THREE / 2

def int_modulo(i: int, j: int) -> int:
    return i % j

def int_floor(i: int, j: int) -> int:
    return i // j - 7 // -2 + MANY // 1000 + MANY * 3

def whole_extremes(i: int, j: int) -> int:
    return max(i, j, 0) * 100 + min(i, j) + abs(i)

def conversions(a: float, i: int) -> float:
    a = min(max(a, -1e9), 1e9)
    return int(a) + float(i) + int(a > 0.0) + float(bool(i)) + int(bool(a))

def functions(a: float, b: float) -> float:
    a = min(max(a, -1e9), 1e9)
    b = min(max(b, -1e9), 1e9)
    return radians(a) + atan2(a, b) + log1p(abs(a)) + copysign(a, b) + floor(a) + ceil(b) * pi

def finite(a: float) -> bool:
    return isfinite(a) and not (isnan(a) or isinf(a))

def conditions(a: float, i: int) -> float:
    if a and not i:
        return 1.0
    elif i or a:
        return 2.0
    else:
        pass
    return 3.0 if a else 4

def inferred(a: float, i: int) -> float:
    n = 1
    x = n
    x = x + a
    even = i % 2 == 0
    n += 2
    half = n
    half /= 2
    if even:
        late = a
    else:
        late = 2
    return x * half + late

def operators(a: float, i: int) -> float:
    x = a
    x += i
    x -= a - 1.0
    x *= a + 2
    x /= 3
    x %= 7.0
    x //= 2
    x **= 2
    k = i
    k *= i - 1
    k //= 3
    k %= 5
    return x + k

def several(a: float, b: float) -> float:
    a, b = b, a
    c, d = a + b, a - b
    c, d = d, c + d
    x = y = c * d
    return x - y * a + c / 3.0

def ranges(n: int, m: int) -> int:
    total = 0
    for i in range(n):
        total = total * 3 + i
    for i in range(m, n):
        total = total * 3 + i
    for i in range(n, m, -2):
        total += i
    for i in range(m, 20, THREE):
        total -= i
    return total

def range_bounds(w: "float[:]", n: int) -> int:
    count = 0
    for i in range(n):
        n = n - 1
        count += i
    w[0] = 5.0
    for _ in range(int(w[0])):
        w[0] = w[0] + 1.0
        count += 1
    return count

def counter(n: int) -> int:
    i = 7
    total = 0
    for i in range(n):
        total += i
        i = i * 2
        total += i
    for i in range(i, i + 3):
        for i in range(2):
            total += i
    return total * 100 + i

def counted(a: float, n: int) -> float:
    """"""
    x = a
    for x in range(n):
        a += 1.0
    return -x + a + HUGE

def leaving(w: "float[:]", n: int) -> float:
    i = 0
    while True:
        i += 1
        if i % 2 == 0:
            continue
        if i > n or w[i % 8] > 2.0:
            break
        w[i % 8] += i
    return w[0] + i

def tables(i: int) -> float:
    total = 0.0
    for j in range(4):
        total += KNOTS[j] * KNOTS[i % 4]
    return total + KNOTS[BACK + 3]

def named(double: float, short: int, log: float, y0: float) -> float:
    int64_t = double + short
    pow = log * y0
    return int64_t ** 2.0 + abs(pow)

def push(w: "float[:]", i: int) -> float:
    w[i % 8] = 2.0 * w[(i + 1) % 8] + w[i % 8] + 1.0
    return w[i % 8]

def peek(w: "float[:]", i: int) -> float:
    return w[i % 8]

def both(a: float, b: float) -> float:
    return 3.0 * a + b

def order(w: "float[:]", i: int) -> float:
    x = push(w, i)
    x -= push(w, i + 1) * i
    w[4] += peek(w, i) / (x * x + 5.0)
    w[5], w[6] = w[6], w[5]
    w[0] = z = push(w, 2)
    if 1.0 < push(w, 1):
        z += 1.0
    elif push(w, 2) > 5.0:
        z -= 1.0
    return x + z if push(w, 1) > 1.0 and push(w, 2) > 0.0 else push(w, 3)

def two_arrays(p: "float[:]", w: "float[:]") -> float:
    return push(w, 1) * p[1] + p[2] * peek(p, 1)

def nothing(unused: float, w: "float[:]"):
    if w[0] > 0.0:
        return
    w[0] = -w[0]
'''
#: Of these: what stands before all functions, and those that random expressions call.
HEAD = SNIPPETS[: SNIPPETS.index("def signs")]
CALLED = SNIPPETS[SNIPPETS.index("def push") : SNIPPETS.index("def order")]
