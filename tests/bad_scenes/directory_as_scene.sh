# A directory in the place of a scene.
debond files
