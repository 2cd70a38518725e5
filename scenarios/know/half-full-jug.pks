problem half-full-jug
domain pouring

init: add(Kf, level = [2, 5]), add(Kf, !served)
goal: K(served)
