problem safe-by-trial
domain opening-a-safe

objects: c1, c2, c3, c4, c5: combination
init: add(Kf, !open), add(Kf, !haveNote),
      add(Kx, rightCombination = c1 | rightCombination = c2 | rightCombination = c3 |
              rightCombination = c4 | rightCombination = c5)
goal: K(open)
