int in_no_room;
