# A safe with one of some combinations. A wrong one does no harm, and that the safe stays closed tells
# that it was wrong; a note tells the right one, which is then used without being known when planning.
domain opening-a-safe

types: combination
predicates: open, haveNote
functions: rightCombination: combination

action dial(?c: combination)
  effects: K(rightCombination = ?c) => add(Kf, open);
           add(Kw, open)

action readNote
  preconds: K(haveNote) & !Kv(rightCombination)
  effects: add(Kv, rightCombination)

action dialWhatIsWritten(?c: combination)
  preconds: K(?c = rightCombination)
  effects: add(Kf, open)
