problem find-a-file
domain unix

objects: paper: file, root, sub1, sub2, sub11, sub12, sub21, sub22: directory
init: add(LCW, subdirectory(?a, ?b)), add(Kf, subdirectory(root, sub1)),
      add(Kf, subdirectory(root, sub2)), add(Kf, subdirectory(sub1, sub11)),
      add(Kf, subdirectory(sub1, sub12)), add(Kf, subdirectory(sub2, sub21)),
      add(Kf, subdirectory(sub2, sub22)), add(Kf, working = root),
      add(LCW, inDirectory(?f, ?d)),
      add(Kx, inDirectory(paper, sub11) | inDirectory(paper, sub12) | inDirectory(paper, sub21) |
              inDirectory(paper, sub22))
goal: K(inDirectory(paper, root))
