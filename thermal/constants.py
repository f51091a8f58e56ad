"""Numbers that every part of the heat model shares."""

#: m/s2
GRAVITY = 9.81
#: 0 degC in K.
ZERO_DEGC = 273.15
#: Highest temperature at which the block is still ice, degC.
MELTING_POINT_DEGC = 0.0
