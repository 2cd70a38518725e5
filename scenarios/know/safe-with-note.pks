problem safe-with-note
domain opening-a-safe

objects: c1, c2, c3, c4, c5: combination
init: add(Kf, !open), add(Kf, haveNote)
goal: K(open)
