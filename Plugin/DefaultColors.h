// The colours that ParaView gives to what the filters make, where its user has no others.
#ifndef DefaultColors_h
#define DefaultColors_h

/// Called when the plugin is loaded: adds settings of ParaView that rank below those of its user.
void SmokeVisibilityAddDefaultColors();

#endif
