# A scene that is not there.
debond no_such_scene.prm
