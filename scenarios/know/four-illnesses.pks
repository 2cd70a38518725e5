problem four-illnesses
domain medicate

objects: i1, i2, i3, i4: illness
init: add(Kf, !cured), add(Kf, !dead), add(LCW, stained(?i)),
      add(Kx, ill(i1) | ill(i2) | ill(i3) | ill(i4))
goal: K(cured) & K(!dead)
