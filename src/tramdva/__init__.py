"""Dynamic vibration absorbers against polygonal tram wheels.

Nomenclature
------------
The letters are those of the paper; every quantity is in SI units.

====== =========================================== =======
symbol quantity                                    unit
====== =========================================== =======
r_C    curve radius at the outer wheel             m
gamma  angle of attack of the leading wheelset     rad
Omega  yaw rate of the vehicle in the curve        rad/s
V_0    rolling speed of the inner wheel            m/s
y_A    lateral displacement of axle and hub        m
y_T    lateral displacement of the absorber        m
y_R    lateral displacement of the rim             m
L      lateral distance of the inner rail          m
m      equivalent mass (A axle, R rim, T absorber) kg
c      effective stiffness (A, R, T)               N/m
d      effective damping (A, R, T)                 N s/m
F_N    normal force at the inner wheel             N
F_y    lateral creep force                         N
w      slip velocity                               m/s
mu     coefficient of friction                     -
====== =========================================== =======
"""
